# repose_register_suites(TARGET LABEL) makes every suite of a GoogleTest program one test of ctest,
# LABEL/SUITE: tests of a suite share what is costly to prepare, and programs that draw in OpenCV
# take longer to start than most tests. Those of its tests that are in repeats.txt are another,
# LABEL/SUITE/repeats.
#
# The same file is the script that ctest runs, once it has read PROGRAM and LABEL: suites are listed
# then, not while building, so that a busy machine cannot break the build.

function(repose_register_suites target label)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  file(GENERATE OUTPUT ${script} CONTENT "set(PROGRAM [[$<TARGET_FILE:${target}>]])
set(LABEL [[${label}]])
include([[${CMAKE_CURRENT_FUNCTION_LIST_FILE}]])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()

# Suites that run code which others run as well, often or for long, to see how nearly right its numbers
# are: they have the label `statistics` too, and are left out where each run takes ten times as long.
set(statistics "^(vision/(ComparePictures|Conditions/.*|FilmAngleAccuracy|HeapPicture|LensFitAccuracy|Likeness|\
OtherPictures|Scenes/.*)|calibrate/(DrawDownFront|JointFit(OfTheBench)?|Narrowing|PositionAngle(/Cone)?|Propose|\
SimulatorVersion|StifferCoefficients)|dem/(DrawDowns|FillAccuracy|FilledTubes|HeapOfManySizes|LongTimestep|\
NeighbourList|RollOnGrains|RollTimestep|RoughDeadGrains|TiltOnGrains)|physics/Verify/Physics)$")
# Suites that start, kill and restart whole programs, each of which other suites run as well: they have
# the label `processes`, and are left out there too.
set(processes "^cli/(CalibrateKilled|CalibrateRanks|CalibrateSheets|Folders|OutputsOf|SimulateRestart)$")
# Suites that compare what different numbers of threads give: `threads`. Races are the thread sanitizer's.
set(threads "Threads$")
# Single tests that run nothing that others do not run: `repeats`.
set(repeats "/repeats$")

# One test of ctest. It is skipped where no test passed and the list of those skipped ends what is
# said: where one failed a list of those would follow.
function(add_suite name filter)
  set(labels "${LABEL}")
  set(cost 0)
  foreach(kind statistics processes threads repeats)
    if(name MATCHES "${${kind}}")
      list(APPEND labels ${kind})
      set(cost 10)  # seconds: started early, so that none is left to end alone
    endif()
  endforeach()
  add_test("${name}" "${PROGRAM}" "--gtest_filter=${filter}")
  set_tests_properties("${name}" PROPERTIES
    LABELS "${labels}" COST ${cost}
    SKIP_REGULAR_EXPRESSION "PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\][^\n]*\n)+$")
endfunction()

if(PROGRAM)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests
    OUTPUT_VARIABLE listing RESULT_VARIABLE result TIMEOUT 120)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} does not list its tests: ${result}")
  endif()
  # Suites begin a line and end in a full stop; their tests are indented.
  string(REGEX MATCHALL "\n[^ \n]+\\." suites "\n${listing}")
  file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/repeats.txt repeated REGEX "^${LABEL}/")
  foreach(suite IN LISTS suites)
    string(REGEX REPLACE "^\n([^ ]+)\\.$" "\\1" suite "${suite}")
    set(tests ${repeated})
    list(FILTER tests INCLUDE REGEX "^${LABEL}/${suite}\\.")
    if(tests)
      list(TRANSFORM tests REPLACE "^${LABEL}/" "")
      foreach(test IN LISTS tests)
        string(REPLACE "${suite}." "" test ${test})
        if(NOT listing MATCHES "\n${suite}\\.\n(  [^\n]*\n)*  ${test}\n")
          message(FATAL_ERROR "tests/repeats.txt names ${LABEL}/${suite}.${test}, which is not there")
        endif()
      endforeach()
      list(JOIN tests ":" tests)
      add_suite("${LABEL}/${suite}/repeats" "${tests}")
      set(tests "-${tests}")
    endif()
    add_suite("${LABEL}/${suite}" "${suite}.*${tests}")
  endforeach()
endif()
