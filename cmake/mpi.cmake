# Provides the target MPI::MPI_CXX if MPI programs can be compiled; otherwise prints a message. An MPI
# installed only to run programs, without headers, makes CMake's own search fail with an error.

function(repose_can_compile_mpi result)
  set(${result} NO PARENT_SCOPE)
  find_program(REPOSE_MPI_COMPILER NAMES mpicxx mpic++ mpiCC mpicxx.openmpi mpicxx.mpich)
  if(REPOSE_MPI_COMPILER)
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/mpi_header.cpp "#include <mpi.h>\n")
    execute_process(COMMAND ${REPOSE_MPI_COMPILER} -E ${CMAKE_CURRENT_BINARY_DIR}/mpi_header.cpp
      RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(failed EQUAL 0)
      set(${result} YES PARENT_SCOPE)
    endif()
  endif()
endfunction()

repose_can_compile_mpi(REPOSE_HAS_MPI)
if(REPOSE_HAS_MPI)
  find_package(MPI COMPONENTS CXX)
endif()
if(NOT TARGET MPI::MPI_CXX)
  message(STATUS "No MPI to compile with: studies run on the cores of one machine. "
    "Fix, to use several: install an MPI with its headers (Debian: libopenmpi-dev) and configure "
    "anew: cmake --fresh")
  set(REPOSE_HAS_MPI NO)
endif()
