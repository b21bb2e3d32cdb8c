# cmake --install puts headers, libraries and a package file in place: find_package(gnomon) then gives gnomon::gnomon, gnomon::metrics, gnomon::headless and gnomon::headless_egl.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS gnomon gnomon_math gnomon_metrics gnomon_headless gnomon_headless_egl EXPORT gnomonTargets FILE_SET HEADERS)
install(EXPORT gnomonTargets NAMESPACE gnomon:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/gnomonConfig.cmake ${PROJECT_SOURCE_DIR}/cmake/Dependencies.cmake
  ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
