# REPOSE_SIMULATOR: a fingerprint of the sources that decide over what a simulation gives. Runs that
# another simulator made are not taken for its own, even if nobody raised the version in between.
file(GLOB_RECURSE simulator_sources CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/dem/*.cpp ${PROJECT_SOURCE_DIR}/dem/*.h
  ${PROJECT_SOURCE_DIR}/render/*.cpp ${PROJECT_SOURCE_DIR}/render/*.h
  ${PROJECT_SOURCE_DIR}/vision/*.cpp ${PROJECT_SOURCE_DIR}/vision/*.h
  ${PROJECT_SOURCE_DIR}/calibrate/study/heap_views.*
  ${PROJECT_SOURCE_DIR}/calibrate/study/position_angle.*)
list(SORT simulator_sources)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${simulator_sources})
set(simulator_hashes "")
foreach(source IN LISTS simulator_sources)
  file(SHA256 ${source} hash)
  string(APPEND simulator_hashes ${hash})
endforeach()
string(SHA256 REPOSE_SIMULATOR "${simulator_hashes}")
string(SUBSTRING ${REPOSE_SIMULATOR} 0 12 REPOSE_SIMULATOR)

# For the files that name it alone: the others need not be compiled again when it changes.
function(repose_names_simulator file)
  set_property(SOURCE ${file} APPEND PROPERTY COMPILE_DEFINITIONS
    "REPOSE_SIMULATOR=\"repose ${PROJECT_VERSION} (${REPOSE_SIMULATOR})\"")
endfunction()
