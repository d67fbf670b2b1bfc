# The page's script, bundled into one file from the sources in page/src with the packages of
# page/package-lock.json.

find_program(REPOSE_NODE_FOR_PAGE NAMES node nodejs REQUIRED)
set(page ${CMAKE_CURRENT_SOURCE_DIR}/page)
set(bundler ${page}/node_modules/esbuild/bin/esbuild)
if(NOT EXISTS ${bundler} OR NOT EXISTS ${page}/node_modules/preact/package.json)
  message(FATAL_ERROR "What `repose studio` is built with was not found in ${page}/node_modules.\n"
    "Fix: run ./setup.sh, or with npm installed\n"
    "  npm ci --ignore-scripts --prefix ${page}")
endif()
file(GLOB page_sources CONFIGURE_DEPENDS ${page}/src/*.ts ${page}/src/*.tsx)
set(REPOSE_STUDIO_SCRIPT ${CMAKE_CURRENT_BINARY_DIR}/page/studio.js)
add_custom_command(OUTPUT ${REPOSE_STUDIO_SCRIPT}
  COMMAND ${REPOSE_NODE_FOR_PAGE} ${bundler} ${page}/src/main.tsx --bundle --minify --target=es2022
    --jsx=automatic --jsx-import-source=preact --legal-comments=none --log-level=warning
    --outfile=${REPOSE_STUDIO_SCRIPT}
  DEPENDS ${page_sources} ${page}/package-lock.json
  COMMENT "Bundling the studio's page"
  VERBATIM)
