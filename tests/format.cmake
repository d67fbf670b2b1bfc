# The test `format`: all sources are formatted according to .clang-format. Versions of clang-format
# differ in their results, so only the one we use will do.

find_program(CLANG_FORMAT clang-format-14)
if(NOT CLANG_FORMAT)
  message(STATUS "clang-format-14 not found: the sources' layout is not tested")
  return()
endif()

set(patterns)
foreach(folder base vision dem render calibrate facade cli studio tests)
  list(APPEND patterns ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.h)
endforeach()
file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns})

add_test(NAME format COMMAND ${CLANG_FORMAT} --dry-run -Werror ${sources})
set_tests_properties(format PROPERTIES LABELS style)
