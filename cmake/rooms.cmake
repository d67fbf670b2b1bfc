# A module is a static library made up of rooms: folders, each of which lists the rooms that it may
# include. tests/layers enforces this.
#
#   repose_add_module(vision)
#   repose_add_room(vision/measure USES base vision/picture LIBRARIES Ceres::ceres)
#
# repose_add_module creates repose_MODULE, called repose::MODULE in the installed package.
# repose_add_room adds all .cpp files of one folder to it, except those listed after WITHOUT, and the
# LIBRARIES that they need. USES lists rooms, or modules all of whose rooms may be used. In unity builds
# (CMAKE_UNITY_BUILD), the sources of a room are compiled as one.

function(repose_add_module module)
  add_library(repose_${module} STATIC)
  add_library(repose::${module} ALIAS repose_${module})
  set_target_properties(repose_${module} PROPERTIES EXPORT_NAME ${module} UNITY_BUILD_MODE GROUP)
  target_compile_features(repose_${module} PUBLIC cxx_std_20)
  target_include_directories(repose_${module} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
endfunction()

function(repose_add_room room)
  cmake_parse_arguments(PARSE_ARGV 1 given "" "" "USES;LIBRARIES;WITHOUT")
  list(JOIN given_USES " " uses)
  set_property(GLOBAL APPEND PROPERTY repose_rooms "${room}: ${uses}")
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${room}/*.cpp)
  foreach(source IN LISTS given_WITHOUT)
    list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/${room}/${source})
  endforeach()
  string(REGEX MATCH "^[^/]+" module ${room})
  target_sources(repose_${module} PRIVATE ${sources})
  string(REPLACE / _ group ${room})
  set_source_files_properties(${sources} PROPERTIES UNITY_GROUP ${group})
  target_link_libraries(repose_${module} PRIVATE ${given_LIBRARIES})
endfunction()

# Writes what each room may use, one line per room, for tests/layers.
function(repose_write_rooms file)
  get_property(rooms GLOBAL PROPERTY repose_rooms)
  list(JOIN rooms "\n" text)
  file(WRITE ${file} "${text}\n")
endfunction()
