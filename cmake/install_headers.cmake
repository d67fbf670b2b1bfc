# Installs the public headers as <repose/...>, those of the facade without their folder. Run by
# `cmake --install` with these variables: source, the project's folder; headers, files in it; folder,
# the include folder below the prefix.

foreach(header IN LISTS headers)
  file(RELATIVE_PATH name ${source} ${header})
  string(REGEX REPLACE "^facade/" "" name ${name})
  set(installed "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${folder}/repose/${name}")
  file(READ ${header} text)
  string(REGEX REPLACE "#include \"((base|vision|dem|render|calibrate)/[^\"]+)\""
    "#include <repose/\\1>" text "${text}")
  set(earlier "")
  if(EXISTS ${installed})
    file(READ ${installed} earlier)
  endif()
  if(NOT "${earlier}" STREQUAL "${text}")
    message(STATUS "Installing: ${installed}")
    file(WRITE ${installed} "${text}")
  endif()
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${CMAKE_INSTALL_PREFIX}/${folder}/repose/${name}")
endforeach()
