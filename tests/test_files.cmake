# repose_register_files(TARGET LABEL) makes every source of a GoogleTest program one test of ctest, named
# after it, such as vision/board_pose: its tests share what is costly to prepare, and programs that draw
# in OpenCV take longer to start than most tests. Those of the kinds below are others:
# vision/film_angle/statistics.
#
# The same file is the script that ctest runs, once it has read PROGRAM, LABEL and LISTING: tests are listed
# then, not while building, so that a busy machine cannot break the build.

function(repose_register_files target label)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_files.cmake)
  file(GENERATE OUTPUT ${script} CONTENT "set(PROGRAM [[$<TARGET_FILE:${target}>]])
set(LABEL [[${label}]])
set(LISTING [[${script}.json]])
include([[${CMAKE_CURRENT_FUNCTION_LIST_FILE}]])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()

# Suites that run code which others run as well, often or for long, to see how nearly right its numbers
# are: they have the label `statistics` too, and are left out where each run takes ten times as long.
set(statistics "^(vision/(ComparePictures|Conditions/.*|FilmAngleAccuracy|HeapPicture|LensFitAccuracy|Likeness|\
OtherPictures|Scenes/.*)|calibrate/(DrawDownFront|IntervalLimit|JointFit(OfTheBench)?|Narrowing|PositionAngle(/Cone)?|Propose|\
SimulatorVersion|StifferCoefficients|MovedCoefficients)|dem/(DrawDowns|FillAccuracy|FilledTubes|HeapOfManySizes|LongTimestep|\
NeighbourList|RollOnGrains|RollTimestep|RoughDeadGrains|TiltOnGrains)|physics/Verify/Physics)$")
# Suites that start, kill and restart whole programs, each of which other suites run as well: they have
# the label `processes`, and are left out there too.
set(processes "^cli/(CalibrateKilled|CalibrateRanks|CalibrateSheets|EngineKilled|Folders|OutputsOf|SimulateRestart)$")
# Suites that compare what different numbers of threads give: `threads`. Races are the thread sanitizer's.
set(threads "Threads$")

# Sets `kind` in the caller to that of a suite, "" for most.
function(find_kind suite)
  set(found "")
  foreach(kind statistics processes threads)
    if("${LABEL}/${suite}" MATCHES "${${kind}}")
      set(found ${kind})
    endif()
  endforeach()
  set(kind "${found}" PARENT_SCOPE)
endfunction()

# One test of ctest. It is skipped where no test passed and the list of those skipped ends what is
# said: where one failed a list of those would follow.
function(add_file name kind tests)
  # Seconds: what takes long is started early, so that none is left to end alone.
  set(cost 0)
  if(LABEL STREQUAL "peers")  # minutes, where the other programs are installed
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
  # A suite's name is less indented than its tests'; a test's file follows its name.
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
