# Bundles viewer/ into the page that report.html is made of. Without npm everything else is built.
option(VANTAGE_BUILD_VIEWER "Bundle the 3D page of report.html (needs npm)" ON)
if(NOT VANTAGE_BUILD_VIEWER)
  return()
endif()
find_program(NPM_PROGRAM npm)
find_program(NODE_PROGRAM NAMES node nodejs)
if(NOT NPM_PROGRAM OR NOT NODE_PROGRAM)
  message(STATUS "npm not found: report.html will not be written")
  return()
endif()

set(viewer ${PROJECT_SOURCE_DIR}/viewer)
set(work ${PROJECT_BINARY_DIR}/viewer)
set(page ${work}/page.html)
file(GLOB viewer_sources CONFIGURE_DEPENDS ${viewer}/src/*)
add_custom_command(
  OUTPUT ${work}/node_modules/.package-lock.json
  COMMAND ${CMAKE_COMMAND} -E copy ${viewer}/package.json ${viewer}/package-lock.json ${viewer}/.npmrc ${work}
  # esbuild ships its program as a package: no install script has to run.
  COMMAND ${NPM_PROGRAM} ci --ignore-scripts --silent
  WORKING_DIRECTORY ${work}
  DEPENDS ${viewer}/package.json ${viewer}/package-lock.json
  COMMENT "Installing the packages of the 3D page" VERBATIM)
add_custom_command(
  OUTPUT ${page}
  COMMAND ${CMAKE_COMMAND} -E copy ${viewer}/build.mjs ${work}
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${viewer}/src ${work}/src
  COMMAND ${NODE_PROGRAM} ${work}/build.mjs ${page}
  DEPENDS ${work}/node_modules/.package-lock.json ${viewer}/build.mjs ${viewer_sources}
  COMMENT "Bundling the 3D page" VERBATIM)
file(MAKE_DIRECTORY ${work})
set_source_files_properties(${PROJECT_SOURCE_DIR}/src/report/report_page.cpp PROPERTIES
  OBJECT_DEPENDS ${page} COMPILE_DEFINITIONS VANTAGE_REPORT_PAGE="${page}"
  TARGET_DIRECTORY vantage)
set_source_files_properties(${page} PROPERTIES GENERATED TRUE TARGET_DIRECTORY vantage)
target_sources(vantage PRIVATE ${page})
