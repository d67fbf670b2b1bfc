# How every target below the including folder is compiled. Nothing of it reaches a project that uses
# the installed package.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

# a*b + c is rounded twice, also where the machine could fuse it into one instruction: the same
# picture gives the same bytes on every machine and with every compiler.
add_compile_options(-ffp-contract=off)

# Presets for developers turn these into errors. -Wfloat-conversion: a pixel position silently cut to
# an int is a wrong angle. (All of -Wconversion objects to how OpenCV assigns its expressions.)
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wfloat-conversion -Wnon-virtual-dtor)
# Of two sources compiled as one, a function of one that hides the other's leaves that unused.
add_compile_options(-Werror=unused-function)
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # In the standard library's own stable_sort.
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
