# Compiles through ccache where it is installed. Paths count from the project's top, so that clones
# of it share what one of them has compiled, and precompiled headers are looked into. (Clang's hold
# paths of their own: with them clones share nothing.)

find_program(REPOSE_CCACHE ccache)
if(REPOSE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
    ${REPOSE_CCACHE})
endif()
