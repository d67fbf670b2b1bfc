# repose_register_files(TARGET LABEL) makes every source of a GoogleTest program one ctest test, named
# after it, such as vision/board_pose: its tests share costly preparation, and programs that draw with
# OpenCV take longer to start than most tests run. Suites of the kinds below become separate tests, such
# as vision/film_angle/statistics.
#
# This file is also the script that ctest runs with PROGRAM, LABEL and LISTING set: tests are listed
# then, not during the build, so that a busy machine cannot break the build.

function(repose_register_files target label)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_files.cmake)
  file(GENERATE OUTPUT ${script} CONTENT "set(PROGRAM [[$<TARGET_FILE:${target}>]])
set(LABEL [[${label}]])
set(LISTING [[${script}.json]])
include([[${CMAKE_CURRENT_FUNCTION_LIST_FILE}]])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()

# Suites that run code covered by others many times or for long, to see how accurate its numbers are:
# they also have the label `statistics`, and are left out when everything runs ten times slower.
set(statistics "^(vision/(ComparePictures|Conditions/.*|FilmAngleAccuracy|HeapPicture|LensFitAccuracy|Likeness|\
OtherPictures|Scenes/.*)|calibrate/(DrawDownFront|IntervalLimit|JointFit(OfTheBench)?|Narrowing|PositionAngle(/Cone)?|Propose|\
SimulatorVersion|StifferCoefficients|StudiesOfCoarseRuns|MovedCoefficients)|dem/(DrawDowns|FillAccuracy|FilledTubes|HeapOfManySizes|LongTimestep|\
NeighbourList|RollOnGrains|RollTimestep|RoughDeadGrains|TiltOnGrains)|physics/Verify/Physics)$")
# Suites that start, kill and restart whole programs, which other suites run as well: they have the
# label `processes`, and are left out then, too.
set(processes "^cli/(CalibrateKilled|CalibrateRanks|CalibrateSheets|EngineKilled|Folders|OutputsOf|SimulateRestart)$")
# Suites that compare results of different numbers of threads: label `threads`. Races are left to the
# thread sanitizer.
set(threads "Threads$")

# Sets `kind` in the caller to the kind of a suite; "" for most.
function(find_kind suite)
  set(found "")
  foreach(kind statistics processes threads)
    if("${LABEL}/${suite}" MATCHES "${${kind}}")
      set(found ${kind})
    endif()
  endforeach()
  set(kind "${found}" PARENT_SCOPE)
endfunction()

# Adds one ctest test. It counts as skipped if no test passed and the output ends with the list of
# skipped tests: after a failure, a list of failed tests would follow.
function(add_file name kind tests)
  # Seconds: long tests are started early, so that none is left running alone at the end.
  set(cost 0)
  if(LABEL STREQUAL "peers")  # minutes, if the other programs are installed
    set(cost 20)
  elseif(kind)
    set(cost 10)
  elseif(LABEL MATCHES "^(cli|calibrate)$")
    set(cost 5)
  endif()
  list(JOIN tests ":" filter)
  add_test("${name}" "${PROGRAM}" "--gtest_filter=${filter}")
  set_tests_properties("${name}" PROPERTIES
    LABELS "${LABEL};${kind}" COST ${cost}
    SKIP_REGULAR_EXPRESSION "PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\][^\n]*\n)+$")
endfunction()

if(PROGRAM)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_output=json:${LISTING}
    OUTPUT_QUIET RESULT_VARIABLE result TIMEOUT 120)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} does not list its tests: ${result}")
  endif()
  # A suite's name is indented less than its tests' names; a test's file follows its name.
  file(STRINGS ${LISTING} lines REGEX "\"(name|file)\":")
  set(names "")
  foreach(line IN LISTS lines)
    string(REPLACE "\\/" "/" line "${line}")
    if(line MATCHES "^      \"name\": \"(.*)\"")
      set(suite "${CMAKE_MATCH_1}")
    elseif(line MATCHES "\"name\": \"(.*)\"")
      set(test "${CMAKE_MATCH_1}")
    else()
      if(NOT line MATCHES "tests/(.*)_test\\.cpp\"")
        message(FATAL_ERROR "${PROGRAM}: the file of ${suite}.${test} is no tests/*_test.cpp: ${line}")
      endif()
      set(name "${CMAKE_MATCH_1}")
      find_kind("${suite}")
      if(kind)
        string(APPEND name "/${kind}")
      endif()
      string(MAKE_C_IDENTIFIER "${name}" key)
      set(kind_${key} "${kind}")
      list(APPEND tests_${key} "${suite}.${test}")
      list(APPEND names "${name}")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES names)
  foreach(name IN LISTS names)
    string(MAKE_C_IDENTIFIER "${name}" key)
    add_file("${name}" "${kind_${key}}" "${tests_${key}}")
  endforeach()
endif()
