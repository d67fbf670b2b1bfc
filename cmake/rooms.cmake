# A module is a library of rooms, a folder each. A room names the rooms that it may include, and
# tests/layers holds it to that.
#
#   repose_add_module(vision LIBRARIES fmt::fmt HEADERS <vector> <fmt/format.h>)
#   repose_add_room(vision/measure USES base vision/picture LIBRARIES Ceres::ceres)
#   repose_add_room(vision/hints COLD USES base vision/picture)
#
# repose_add_module makes the static library repose_MODULE, which users of the installed package know
# as repose::MODULE. All of its rooms are compiled with LIBRARIES and OPTIONS; HEADERS are compiled
# once for all of them. repose_add_room adds all .cpp files of one folder but those after WITHOUT.
# USES names rooms, or modules all of whose rooms may be used. COLD says that the room's own code never
# takes long: a release compiles it with -O1, in two thirds of the time. TEXT says that it does little
# but put words together: it is compiled with -O0, the sanitizers' in half the time. (Sources compiled
# one by one have -O1, or the level of their precompiled header, which g++ takes instead.)
#
# A room is a target of its own. Only where sources are compiled as few (CMAKE_UNITY_BUILD) those of
# all rooms of a module are, in less than half the time, those of COLD and of TEXT apart: what its
# sources have for themselves, in unnamed namespaces, has then names of its own.

function(repose_add_module module)
  cmake_parse_arguments(PARSE_ARGV 1 given "" "" "LIBRARIES;OPTIONS;HEADERS")
  add_library(repose_${module} STATIC)
  add_library(repose::${module} ALIAS repose_${module})
  set_target_properties(repose_${module} PROPERTIES EXPORT_NAME ${module} LINKER_LANGUAGE CXX)
  target_compile_features(repose_${module} PUBLIC cxx_std_20)
  target_include_directories(repose_${module} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(repose_${module} PRIVATE ${given_LIBRARIES})
  set_property(TARGET repose_${module} PROPERTY REPOSE_LIBRARIES "${given_LIBRARIES}")
  set_property(TARGET repose_${module} PROPERTY REPOSE_OPTIONS "${given_OPTIONS}")
  repose_add_headers(repose_${module}_headers
    LIBRARIES ${given_LIBRARIES} OPTIONS ${given_OPTIONS} HEADERS ${given_HEADERS})
  if(CMAKE_UNITY_BUILD)  # what takes long comes first, as in repose_link_modules
    foreach(kind "" _cold _text)
      set(target repose_room_${module}${kind})
      target_sources(repose_${module} PRIVATE
        $<$<TARGET_EXISTS:${target}>:$<TARGET_OBJECTS:${target}>>)
    endforeach()
  endif()
endfunction()

# Of the copies of an inline function the linker takes the first: that of the module whose code takes
# longest, compiled with most care, not one of a test or of a command. All of the modules is linked.
# What the standard library has comes first: else lld takes it from any of our libraries that has a copy,
# and with that all that this library needs (OpenCV, for tests that draw nothing).
function(repose_link_modules program)
  target_link_options(${program} PRIVATE -lstdc++)
  foreach(module dem vision render calibrate base cli)
    if(repose_${module} IN_LIST ARGN)
      target_link_options(${program} PRIVATE
        LINKER:--whole-archive,$<TARGET_FILE:repose_${module}>,--no-whole-archive)
    endif()
  endforeach()
  target_link_libraries(${program} PRIVATE ${ARGN})
endfunction()

function(repose_add_room room)
  cmake_parse_arguments(PARSE_ARGV 1 given "COLD;TEXT" "" "USES;LIBRARIES;WITHOUT")
  set(kind "")
  if(given_COLD)
    set(kind _cold)
  elseif(given_TEXT)
    set(kind _text)
  endif()
  list(JOIN given_USES " " uses)
  set_property(GLOBAL APPEND PROPERTY repose_rooms "${room}: ${uses}")
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${room}/*.cpp)
  foreach(source IN LISTS given_WITHOUT)
    list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/${room}/${source})
  endforeach()
  if(NOT sources)  # headers alone
    return()
  endif()
  string(REGEX MATCH "^[^/]+" module ${room})
  if(CMAKE_UNITY_BUILD)
    set(room ${module}${kind})
  endif()
  string(REPLACE / _ target repose_room_${room})
  if(NOT TARGET ${target})
    repose_add_room_target(${target} ${module} "${kind}")
  endif()
  target_sources(${target} PRIVATE ${sources})
  target_link_libraries(${target} PRIVATE ${given_LIBRARIES})
  target_link_libraries(repose_${module} PRIVATE ${given_LIBRARIES})
endfunction()

function(repose_add_room_target target module kind)
  get_target_property(libraries repose_${module} REPOSE_LIBRARIES)
  get_target_property(options repose_${module} REPOSE_OPTIONS)
  add_library(${target} OBJECT)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_options(${target} PRIVATE ${options})
  if(kind STREQUAL _text AND CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE -O0)
  elseif(kind)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  target_link_libraries(${target} PRIVATE ${libraries})
  repose_use_headers(${target} repose_${module}_headers)
  if(NOT CMAKE_UNITY_BUILD)
    target_sources(repose_${module} PRIVATE $<TARGET_OBJECTS:${target}>)
  endif()
endfunction()

# Headers that many sources include, compiled once where each source is compiled alone: a target of
# their own, which those that are compiled with the same options may use.
function(repose_add_headers target)
  cmake_parse_arguments(PARSE_ARGV 1 given "" "" "LIBRARIES;OPTIONS;HEADERS")
  if(CMAKE_UNITY_BUILD OR NOT given_HEADERS)
    return()
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Nothing but what all sources include first.\n")
  add_library(${target} OBJECT ${source})
  target_compile_options(${target} PRIVATE ${given_OPTIONS})
  target_link_libraries(${target} PRIVATE ${given_LIBRARIES})
  target_precompile_headers(${target} PRIVATE ${given_HEADERS})
endfunction()

function(repose_use_headers target headers)
  if(TARGET ${headers})
    target_precompile_headers(${target} REUSE_FROM ${headers})
  endif()
endfunction()

# Writes what rooms may use, a line each: for tests/layers.
function(repose_write_rooms file)
  get_property(rooms GLOBAL PROPERTY repose_rooms)
  list(JOIN rooms "\n" text)
  file(WRITE ${file} "${text}\n")
endfunction()
