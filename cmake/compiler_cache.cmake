# Compiles through ccache if it is installed. Paths are relative to the project's root, so that clones
# share what one of them has compiled, and the contents of precompiled headers are hashed. (Clang's
# contain absolute paths: with them, clones share nothing.)

find_program(REPOSE_CCACHE ccache)
if(REPOSE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
    ${REPOSE_CCACHE})
endif()
