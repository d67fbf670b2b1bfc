# Compile options for every target below the including folder. None of them reach projects that use
# the installed package.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

# a*b + c is rounded twice, even if the machine could fuse it into one instruction, so that the same
# picture gives the same bytes on every machine and with every compiler.
add_compile_options(-ffp-contract=off)

# Developer presets turn these into errors. -Wfloat-conversion: a pixel position silently truncated to
# an int gives a wrong angle. (-Wconversion as a whole objects to how OpenCV assigns its expressions.)
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wfloat-conversion -Wnon-virtual-dtor)
# If two sources compiled as one define the same function, one hides the other, which is then unused.
add_compile_options(-Werror=unused-function)
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # For the standard library's own stable_sort.
  add_compile_options(-Wno-deprecated-declarations)
endif()

if(REPOSE_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
    message(FATAL_ERROR "REPOSE_FUZZERS needs Clang, and the compiler is ${CMAKE_CXX_COMPILER_ID}.\n"
      "Fix: cmake --preset fuzz")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link,address)
  add_link_options(-fsanitize=address)
endif()
