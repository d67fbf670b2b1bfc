# repose_register_suites(TARGET LABEL) makes every suite of a GoogleTest program one test of ctest,
# LABEL/SUITE: tests of a suite share what is costly to prepare, and programs that draw in OpenCV
# take longer to start than most tests.
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

if(PROGRAM)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests
    OUTPUT_VARIABLE listing RESULT_VARIABLE result TIMEOUT 120)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} does not list its tests: ${result}")
  endif()
  # Suites begin a line and end in a full stop; their tests are indented.
  string(REGEX MATCHALL "\n[^ \n]+\\." suites "\n${listing}")
  foreach(suite IN LISTS suites)
    string(STRIP "${suite}" suite)
    string(REGEX REPLACE "\\.$" "" name "${suite}")
    add_test("${LABEL}/${name}" "${PROGRAM}" "--gtest_filter=${suite}*")
    set(labels "${LABEL}")
    set(cost 0)
    foreach(kind statistics processes threads)
      if("${LABEL}/${name}" MATCHES "${${kind}}")
        list(APPEND labels ${kind})
        set(cost 10)  # seconds: started early, so that none is left to end alone
      endif()
    endforeach()
    # Skipped as a whole: no test passed, and the list of those skipped ends what is said. Where one
    # failed a list of those would follow.
    set_tests_properties("${LABEL}/${name}" PROPERTIES
      LABELS "${labels}" COST ${cost}
      SKIP_REGULAR_EXPRESSION "PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\][^\n]*\n)+$")
  endforeach()
endif()
