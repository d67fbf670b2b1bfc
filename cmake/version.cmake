# REPOSE_VERSION: the version of the program and of packages. In a clone it is read from the repository
# when CMake configures: 0.2.0 at the tag v0.2.0, 0.2.0+3.g1a2b3c4 three commits later, and without any
# tag the project's version with the commit, 0.1.0+g1a2b3c4. In an unpacked archive, or without git, it
# is the project's version alone.

function(repose_describe_version described version result)
  if(described MATCHES "^v([0-9]+\\.[0-9]+\\.[0-9]+)-0-g")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  elseif(described MATCHES "^v([0-9]+\\.[0-9]+\\.[0-9]+)-([0-9]+)-g([0-9a-f]+)$")
    set(${result} ${CMAKE_MATCH_1}+${CMAKE_MATCH_2}.g${CMAKE_MATCH_3} PARENT_SCOPE)
  elseif(described MATCHES "^[0-9a-f]+$")
    set(${result} ${version}+g${described} PARENT_SCOPE)
  else()
    set(${result} ${version} PARENT_SCOPE)
  endif()
endfunction()

set(repose_described "")
find_program(REPOSE_GIT git)
# Ignores the repository of another project that this one may have been unpacked into.
if(REPOSE_GIT AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  execute_process(COMMAND ${REPOSE_GIT} describe --tags --long --always --match "v[0-9]*"
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE repose_described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
repose_describe_version("${repose_described}" ${PROJECT_VERSION} REPOSE_VERSION)
