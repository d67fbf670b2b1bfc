# `cpack --config build/release/CPackConfig.cmake -B FOLDER`: a Debian package of the program with its
# manual pages, completions and documents. Its dependencies are read from the program itself.

# Packs what has been built, so that cpack does not build the tests first.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME repose)
set(CPACK_PACKAGE_VERSION ${REPOSE_VERSION})
set(CPACK_PACKAGE_CONTACT "the repose project <repose@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "angle of repose in photographs, and contact coefficients for the discrete element method")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME repose)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Opened at run time: the font of overlays.
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
include(CPack)
