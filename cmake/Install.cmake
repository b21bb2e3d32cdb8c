# cmake --install puts libraries, headers, plugins, programs and package files in place. find_package(gnomon) then gives
# gnomon::gnomon, gnomon::headless and gnomon::headless_egl; pkg-config gives gnomon.
# Components are the parts of the Debian packages, see Package.cmake: runtime, dev, tools, doc.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
set(libraries gnomon)
# gnomon_install(EXPORT TARGET...): each export is a file of targets of its own, for find_package() reads those that it can.
function(gnomon_install export)
  install(TARGETS ${ARGN} EXPORT ${export}
    LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev
    ARCHIVE COMPONENT dev
    FILE_SET HEADERS COMPONENT dev)
  install(EXPORT ${export} NAMESPACE gnomon:: DESTINATION ${package_folder} COMPONENT dev)
endfunction()
gnomon_install(gnomonTargets gnomon)
foreach(pair Headless:gnomon_headless HeadlessEgl:gnomon_headless_egl)
  string(REGEX MATCH "(.*):(.*)" pair ${pair})
  if(TARGET ${CMAKE_MATCH_2})
    list(APPEND libraries ${CMAKE_MATCH_2})
    gnomon_install(gnomon${CMAKE_MATCH_1}Targets ${CMAKE_MATCH_2})
  endif()
endforeach()
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(${PROJECT_SOURCE_DIR}/cmake/gnomonConfig.cmake.in ${PROJECT_BINARY_DIR}/gnomonConfig.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/gnomonConfig.cmake ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/OsgTargets.cmake ${PROJECT_SOURCE_DIR}/cmake/OSMesa.cmake
  ${PROJECT_SOURCE_DIR}/cmake/MathLibraries.cmake DESTINATION ${package_folder} COMPONENT dev)

# pkg-config finds the rest from the place of its own file.
file(RELATIVE_PATH pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" pc_prefix ${pc_prefix})
configure_file(${PROJECT_SOURCE_DIR}/cmake/gnomon.pc.in ${PROJECT_BINARY_DIR}/gnomon.pc @ONLY)
if(BUILD_SHARED_LIBS) # CMake knows what a static library needs
  install(FILES ${PROJECT_BINARY_DIR}/gnomon.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endif()

# The guide, with what it links to, as it lies in the repository: so its links hold.
set(guide ${CMAKE_INSTALL_DATADIR}/doc/gnomon-doc)
install(FILES README.md CONTRIBUTING.md DESTINATION ${guide} COMPONENT doc)
install(FILES data/SOURCES.md DESTINATION ${guide}/data COMPONENT doc)
install(DIRECTORY docs DESTINATION ${guide} COMPONENT doc PATTERN site EXCLUDE)
install(DIRECTORY examples/addshadows examples/owntechnique examples/tutorial DESTINATION ${guide}/examples COMPONENT doc)

# All that is installed: cmake --build build --target packaged
get_property(tools GLOBAL PROPERTY GNOMON_TOOLS)
if(BUILD_SHARED_LIBS)
  list(APPEND libraries osgdb_gnomon osgdb_serializers_gnomon)
endif()
add_custom_target(packaged DEPENDS ${libraries} ${tools})
if(tools)
  add_dependencies(packaged man_pages)
endif()
