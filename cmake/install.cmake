# Installs the library, the program and a package config for find_package(vantage).
include(CMakePackageConfigHelpers)
install(TARGETS vantage EXPORT vantage-targets)
install(DIRECTORY include/vantage DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT vantage-targets NAMESPACE vantage:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vantage)
configure_package_config_file(cmake/vantage-config.cmake.in vantage-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vantage)
write_basic_package_version_file(vantage-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vantage-config.cmake ${PROJECT_BINARY_DIR}/vantage-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vantage)
if(TARGET vantage_program)
  install(TARGETS vantage_program)
  # File managers show models: run update-mime-database on share/mime afterwards, as packages do.
  install(FILES apps/vantage/desktop/vantage.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers)
  install(FILES apps/vantage/desktop/vantage-mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
    RENAME vantage.xml)
endif()
