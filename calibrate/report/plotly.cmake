# The library that draws a report's charts is not in this repository: package.json names it,
# package-lock.json has its hash, and `npm ci` fetches it and refuses anything else.

file(READ ${CMAKE_CURRENT_SOURCE_DIR}/report/package.json package)
string(JSON wanted GET "${package}" dependencies plotly.js-dist-min)
set(modules ${CMAKE_CURRENT_SOURCE_DIR}/report/node_modules)
set(found none)
if(EXISTS ${modules}/plotly.js-dist-min/package.json)
  file(READ ${modules}/plotly.js-dist-min/package.json package)
  string(JSON found GET "${package}" version)
endif()
if(NOT found STREQUAL wanted OR NOT EXISTS ${modules}/plotly.js-dist-min/plotly.min.js)
  message(FATAL_ERROR "plotly.js-dist-min ${wanted} is needed for `repose report`, and this was found "
    "in ${modules}: ${found}.\n"
    "Fix: run ./setup.sh, or with npm installed\n"
    "  npm ci --ignore-scripts --prefix ${CMAKE_CURRENT_SOURCE_DIR}/report")
endif()
# Compressed, since pages are sent by e-mail. page/inflate.js decompresses it.
set(REPOSE_PLOTLY ${CMAKE_CURRENT_BINARY_DIR}/report/plotly.min.js.gz)
set(plotly ${modules}/plotly.js-dist-min/plotly.min.js)
if(${plotly} IS_NEWER_THAN ${REPOSE_PLOTLY})
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/report)
  file(ARCHIVE_CREATE OUTPUT ${REPOSE_PLOTLY} PATHS ${plotly}
    FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
endif()
