# `cmake --install`: the program, the libraries with their public headers, and a CMake package:
# find_package(repose) gives the targets repose::vision, repose::dem, repose::render,
# repose::calibrate.

include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/repose)

# Users write <repose/vision/repose_angle.h>; the headers name each other "vision/picture.h".
install(TARGETS repose_io repose_vision repose_dem repose_render repose_calibrate
  EXPORT reposeTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/repose
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS repose_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT reposeTargets NAMESPACE repose:: DESTINATION ${package_folder})
configure_package_config_file(cmake/reposeConfig.cmake.in reposeConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(reposeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/reposeConfig.cmake
  ${PROJECT_BINARY_DIR}/reposeConfigVersion.cmake
  DESTINATION ${package_folder})
