# The target `tidy`: all sources under clang-tidy, whose warnings are errors. It compiles nothing.
# One folder or file: run-clang-tidy-22 -p build/release vision/measure

find_program(RUN_CLANG_TIDY run-clang-tidy-22)
if(NOT RUN_CLANG_TIDY)
  message(STATUS "clang-tidy-22 not found: there is no target tidy")
  return()
endif()

cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
add_custom_target(tidy
  COMMAND ${RUN_CLANG_TIDY} -p ${PROJECT_BINARY_DIR} -j ${cores} -quiet -hide-progress
    -warnings-as-errors=*
    "^${PROJECT_SOURCE_DIR}/(base|vision|dem|render|calibrate|cli|tests)/"
  COMMENT "Looking through the sources"
  VERBATIM)
