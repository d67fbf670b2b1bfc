# The tests `package_install` and `package`: the installed files are enough for an external project
# (tests/package) to find the package, compile, link and run.

set(prefix ${CMAKE_CURRENT_BINARY_DIR}/package/prefix)

add_test(NAME package_install
  COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
set_tests_properties(package_install PROPERTIES
  FIXTURES_SETUP installed_package LABELS package)

add_test(NAME package
  COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/package ${CMAKE_CURRENT_BINARY_DIR}/package/build
    --build-generator ${CMAKE_GENERATOR}
    --build-options
      -DCMAKE_PREFIX_PATH=${prefix}
      -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
      -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}
      -DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}
      -DPHOTOS=${PROJECT_SOURCE_DIR}/samples/hazelnut/photos
    --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure)
set_tests_properties(package PROPERTIES FIXTURES_REQUIRED installed_package LABELS package)

# The version from the repository, and the Debian package with that version.
add_test(NAME version COMMAND ${CMAKE_COMMAND} -P ${CMAKE_CURRENT_SOURCE_DIR}/version.cmake)
add_test(NAME package_deb
  COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/package/make_deb ${CMAKE_CPACK_COMMAND}
    ${PROJECT_BINARY_DIR}/CPackConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/package/deb)
set_tests_properties(version package_deb PROPERTIES LABELS package SKIP_RETURN_CODE 77)
