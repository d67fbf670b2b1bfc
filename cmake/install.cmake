# `cmake --install`: the program, the libraries with their public headers, and a CMake package:
# find_package(repose COMPONENTS vision) gives the target repose::vision and needs no more than the
# libraries that vision links; likewise dem, render and calibrate. Without COMPONENTS it gives all.

include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/repose)

# Users write <repose/vision/picture/picture.h>; the headers name each other without "repose/".
foreach(module base vision dem render calibrate)
  install(TARGETS repose_${module}
    EXPORT repose_${module}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/repose
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT repose_${module}
    NAMESPACE repose:: DESTINATION ${package_folder} FILE repose_${module}.cmake)
endforeach()
# The component "program" is what a package for users has.
install(TARGETS repose_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
set(help_folder ${PROJECT_BINARY_DIR}/help)
install(FILES ${help_folder}/repose
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${help_folder}/_repose
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
install(DIRECTORY ${help_folder}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)

configure_package_config_file(cmake/reposeConfig.cmake.in reposeConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(reposeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/reposeConfig.cmake
  ${PROJECT_BINARY_DIR}/reposeConfigVersion.cmake
  DESTINATION ${package_folder})
