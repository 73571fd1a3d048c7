# Installs the program and what belongs to it (component `program`), and the library with its headers,
# find_package(vantage) and pkg-config files (component `development`).
include(CMakePackageConfigHelpers)
set(VANTAGE_DOC_DIR ${CMAKE_INSTALL_DATADIR}/doc)

install(TARGETS vantage EXPORT vantage-targets
  ARCHIVE COMPONENT development
  LIBRARY COMPONENT program NAMELINK_COMPONENT development)
install(DIRECTORY include/vantage DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.h")
install(EXPORT vantage-targets NAMESPACE vantage:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vantage
  COMPONENT development)
configure_package_config_file(cmake/vantage-config.cmake.in vantage-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vantage)
write_basic_package_version_file(vantage-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vantage-config.cmake ${PROJECT_BINARY_DIR}/vantage-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vantage COMPONENT development)
set(VANTAGE_PC_LIBS "")
if(NOT BUILD_SHARED_LIBS)  # an archive does not name what it needs
  set(VANTAGE_PC_LIBS "-ltbb -lembree3 -lpng -ljpeg -lz -lwebpmux -lwebp -ldraco -larchive -lexpat -lmeshoptimizer -lmetis")
endif()
file(RELATIVE_PATH VANTAGE_PC_UP "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(cmake/vantage.pc.in vantage.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/vantage.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
set(words ${PROJECT_BINARY_DIR}/words)
file(MAKE_DIRECTORY ${words}/man)
add_custom_command(OUTPUT ${words}/NOTICES
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${words}/NOTICES -DTHREE=${PROJECT_BINARY_DIR}/viewer/node_modules/three/LICENSE
          -P ${PROJECT_SOURCE_DIR}/cmake/write_notices.cmake
  DEPENDS vantage ${PROJECT_SOURCE_DIR}/cmake/write_notices.cmake VERBATIM)
add_custom_target(vantage_notices ALL DEPENDS ${words}/NOTICES)
install(FILES THIRD_PARTY.md ${words}/NOTICES DESTINATION ${VANTAGE_DOC_DIR}/libvantage-dev COMPONENT development)
install(FILES LICENSE DESTINATION ${VANTAGE_DOC_DIR}/libvantage-dev RENAME copyright COMPONENT development)

if(TARGET vantage_program)
  install(TARGETS vantage_program COMPONENT program)
  # File managers show models: run update-mime-database on share/mime afterwards, as packages do.
  install(FILES apps/vantage/desktop/vantage.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers
    COMPONENT program)
  install(FILES apps/vantage/desktop/vantage-mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
    RENAME vantage.xml COMPONENT program)
  install(FILES THIRD_PARTY.md ${words}/NOTICES README.md DESTINATION ${VANTAGE_DOC_DIR}/vantage COMPONENT program)
  install(FILES LICENSE DESTINATION ${VANTAGE_DOC_DIR}/vantage RENAME copyright COMPONENT program)

  # Manual pages and completions, written by the program itself from the options that it parses.
  add_custom_command(OUTPUT ${words}/written
    COMMAND vantage_program manual ${words}/man
    COMMAND vantage_program completion bash > ${words}/vantage
    COMMAND vantage_program completion zsh > ${words}/_vantage
    COMMAND vantage_program completion fish > ${words}/vantage.fish
    COMMAND find ${words}/man -name "*.1" -exec gzip -9nf {} +
    COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md > ${words}/changelog.gz
    COMMAND ${CMAKE_COMMAND} -E touch ${words}/written
    DEPENDS vantage_program ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    COMMENT "Writing manual pages and completions" VERBATIM)
  add_custom_target(vantage_words ALL DEPENDS ${words}/written)
  install(DIRECTORY ${words}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES ${words}/changelog.gz DESTINATION ${VANTAGE_DOC_DIR}/vantage COMPONENT program)
  install(FILES ${words}/vantage DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  install(FILES ${words}/_vantage DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
  install(FILES ${words}/vantage.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
    COMPONENT program)
endif()
if(TARGET vantage_import)  # a package of its own: `cmake --install` without a component leaves it out
  install(TARGETS vantage_import DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/vantage COMPONENT import EXCLUDE_FROM_ALL)
  install(FILES apps/import/desktop/vantage-import.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers
    COMPONENT import EXCLUDE_FROM_ALL)
  install(FILES apps/import/desktop/vantage-import-mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
    RENAME vantage-import.xml COMPONENT import EXCLUDE_FROM_ALL)
  install(FILES LICENSE DESTINATION ${VANTAGE_DOC_DIR}/vantage-import RENAME copyright COMPONENT import EXCLUDE_FROM_ALL)
  install(FILES THIRD_PARTY.md DESTINATION ${VANTAGE_DOC_DIR}/vantage-import COMPONENT import EXCLUDE_FROM_ALL)
endif()
include(cmake/package.cmake)
