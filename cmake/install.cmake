# `cmake --install`: the program, the libraries with their public headers, and a CMake package:
# find_package(repose COMPONENTS vision) provides the target repose::vision and needs only the
# libraries that vision links; likewise dem, render and calibrate. Without COMPONENTS it provides all.

include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/repose)

# Users include <repose/measure.h> or <repose/vision/picture/picture.h>. The headers include each other
# without "repose/", which install_headers.cmake prepends: include/repose itself is not an include path.
file(GLOB public_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/facade/*.h)
foreach(module base vision dem render calibrate)
  get_target_property(headers repose_${module} HEADER_SET)
  list(APPEND public_headers ${headers})
endforeach()
set_property(GLOBAL PROPERTY repose_public_headers "${public_headers}")  # for tests/layers
install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")
set(folder \"${CMAKE_INSTALL_INCLUDEDIR}\")
set(headers \"${public_headers}\")")
install(SCRIPT cmake/install_headers.cmake)
foreach(module base vision dem render calibrate)
  install(TARGETS repose_${module}
    EXPORT repose_${module}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT repose_${module}
    NAMESPACE repose:: DESTINATION ${package_folder} FILE repose_${module}.cmake)
endforeach()
# The component "program" is the content of a package for users.
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
