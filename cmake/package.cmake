# Packages: cpack --config build/release/CPackConfig.cmake makes vantage_*.deb, libvantage-dev_*.deb and a
# tarball. Timestamps come from SOURCE_DATE_EPOCH where it is set, so that the same commit gives the same bytes.
set(CPACK_PACKAGE_VENDOR "The Vantage authors")
set(CPACK_PACKAGE_CONTACT "The Vantage authors <vantage@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "finds the view of a 3D model that tells most about its shape")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_GENERATOR DEB TGZ)
if(TARGET vantage_import)
  list(APPEND CPACK_COMPONENTS_ALL import)
endif()

set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME vantage)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS shared-mime-info)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libvantage-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev, libtbb-dev, libembree-dev, libpng-dev, libjpeg-dev, zlib1g-dev, libwebp-dev, libdraco-dev, libarchive-dev, libexpat1-dev, libmeshoptimizer-dev, libmetis-dev")
set(CPACK_DEBIAN_IMPORT_PACKAGE_NAME vantage-import)
set(CPACK_DEBIAN_IMPORT_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_IMPORT_PACKAGE_DEPENDS "vantage (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "Contracts the surface of a 3D model to a curve skeleton, turns the history
of the contraction into a map of significance, and searches the view sphere
for the viewpoint that sees most of it. Writes pictures, cameras, reports and
thumbnails; headless, deterministic, for one model or a whole collection.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Headers and static library of vantage, with its CMake package and
pkg-config file.")
set(CPACK_COMPONENT_IMPORT_DESCRIPTION
  "Lets vantage read STEP, IGES, BREP, FBX, COLLADA, 3DS, X, BLEND and other
formats by Open CASCADE and Assimp, in a confined process of its own.")
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package_permissions.cmake)
include(CPack)
