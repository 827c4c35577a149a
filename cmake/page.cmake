# A page is a folder with package.json, build.mjs and src/ that node bundles into one HTML template,
# which the library embeds. node_modules lives in the source folder (ignored by git) because that is
# where node looks for it.
#
#   verdigris_add_page("${CMAKE_BINARY_DIR}/viewer/viewer.html" "the viewer")
function(verdigris_add_page html what)
  find_program(VERDIGRIS_NPM npm REQUIRED)
  find_program(VERDIGRIS_NODE node REQUIRED)
  verdigris_add_packages(stamp "${what}")
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/src/*")
  add_custom_command(
    OUTPUT "${html}"
    COMMAND ${VERDIGRIS_NPM} run --silent check
    COMMAND ${VERDIGRIS_NODE} build.mjs "${html}"
    DEPENDS "${stamp}" ${sources} build.mjs tsconfig.json
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
    COMMENT "Building ${what}" VERBATIM)
endfunction()

# Installs the packages of this folder when its lock file changes; `stamp` names the file to depend on.
function(verdigris_add_packages stamp what)
  find_program(VERDIGRIS_NPM npm REQUIRED)
  set(file "${CMAKE_CURRENT_SOURCE_DIR}/node_modules/.verdigris-stamp")
  add_custom_command(
    OUTPUT "${file}"
    COMMAND ${VERDIGRIS_NPM} ci --silent --no-audit --no-fund
    COMMAND ${CMAKE_COMMAND} -E touch "${file}"
    DEPENDS package.json package-lock.json
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
    COMMENT "Installing the packages of ${what}" VERBATIM)
  set(${stamp} "${file}" PARENT_SCOPE)
endfunction()
