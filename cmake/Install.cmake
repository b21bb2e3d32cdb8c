# cmake --install puts libraries, headers, plugins, programs and package files in place. find_package(gnomon) then gives
# gnomon::gnomon, gnomon::metrics, gnomon::headless and gnomon::headless_egl; pkg-config gives gnomon.
# Components are the parts of the Debian packages, see Package.cmake: runtime, dev, tools, doc.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
install(TARGETS gnomon gnomon_math gnomon_metrics gnomon_headless gnomon_headless_egl EXPORT gnomonTargets
  LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev
  ARCHIVE COMPONENT dev
  FILE_SET HEADERS COMPONENT dev)
install(EXPORT gnomonTargets NAMESPACE gnomon:: DESTINATION ${package_folder} COMPONENT dev)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/gnomonConfig.cmake ${PROJECT_SOURCE_DIR}/cmake/Dependencies.cmake
  ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake DESTINATION ${package_folder} COMPONENT dev)

# pkg-config finds the rest from the place of its own file.
file(RELATIVE_PATH pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" pc_prefix ${pc_prefix})
configure_file(${PROJECT_SOURCE_DIR}/cmake/gnomon.pc.in ${PROJECT_BINARY_DIR}/gnomon.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/gnomon.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*.png ${PROJECT_SOURCE_DIR}/docs/*.svg)
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon-doc/pages COMPONENT doc)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/gallery DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon-doc/pages COMPONENT doc)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon-doc COMPONENT doc)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/addshadows
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon-doc/examples COMPONENT doc)

# All that is installed: cmake --build build --target packaged
get_property(tools GLOBAL PROPERTY GNOMON_TOOLS)
add_custom_target(packaged DEPENDS
  gnomon gnomon_math gnomon_metrics gnomon_headless gnomon_headless_egl osgdb_gnomon osgdb_serializers_gnomon ${tools})
if(tools)
  add_dependencies(packaged man_pages)
endif()
