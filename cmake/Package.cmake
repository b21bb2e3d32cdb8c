# cpack makes Debian packages of the installed components: libgnomon1, libgnomon-dev, gnomon-tools and gnomon-doc.
# `./check package` builds and tries them.
set(GNOMON_MAINTAINER "The Gnomon authors <gnomon@gnomon.invalid>" CACHE STRING "Maintainer that the packages name")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_CONTACT "${GNOMON_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/StripPaths.cmake)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev doc)
if(GNOMON_PROGRAMS OR GNOMON_TESTS)
  list(APPEND CPACK_COMPONENTS_ALL tools)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
if(PROJECT_HOMEPAGE_URL) # an empty one is no field
  set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${PROJECT_HOMEPAGE_URL}")
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(same_version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

# gnomon_package(COMPONENT NAME SECTION SHORT LONG) describes one package. All descriptions begin alike.
set(GNOMON_DESCRIPTION "Gnomon adds shadows to OpenSceneGraph scenes: exact shadows on planes, shadows
of buildings on terrain, shadow maps, stencil volumes, and shadows by traced
rays.")
macro(gnomon_package component name section short long)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION
    "shadow NodeKit for OpenSceneGraph - ${short}\n${GNOMON_DESCRIPTION}\n.\n${long}")
  set(document_folder ${CMAKE_INSTALL_DATADIR}/doc/${name})
  install(FILES ${PROJECT_BINARY_DIR}/package/copyright ${PROJECT_BINARY_DIR}/package/changelog.Debian.gz
    ${PROJECT_BINARY_DIR}/package/changelog.gz DESTINATION ${document_folder} COMPONENT ${component} OPTIONAL)
endmacro()

gnomon_package(runtime libgnomon1 libs "library and plugins"
"This package holds the shared library, and plugins by which osgviewer and any
other program that loads files shows shadows without code.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/triggers ${PROJECT_BINARY_DIR}/package/shlibs)

gnomon_package(dev libgnomon-dev libdevel "development files"
"This package holds headers, static libraries, and package files for CMake and
pkg-config.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libgnomon1 ${same_version}, libopenscenegraph-dev, libglm-dev")
# For the components headless and headless_egl of find_package(gnomon).
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libegl-dev, pkg-config")
if(GNOMON_HAS_OSMESA)
  string(PREPEND CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libosmesa6-dev, ")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "gnomon-doc")

gnomon_package(tools gnomon-tools graphics "programs"
"This package holds programs that show scenes with shadows, draw pictures
without a display, put shadows into other programs, and measure speed and
accuracy.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "libgnomon1 ${same_version}, python3-matplotlib, python3-jinja2")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "openscenegraph")

gnomon_package(doc gnomon-doc doc "documentation"
"This package holds the guide and two examples.")
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)

# What Debian wants in each package's folder of documents.
set(GNOMON_PACKAGE_VERSION ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(folder ${PROJECT_BINARY_DIR}/package)
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX REPLACE "^.*The Gnomon authors\n\n" "" licence "${licence}")
string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REGEX REPLACE "\n$" "" licence "${licence}")
string(REPLACE "\n" "\n " licence " ${licence}")
configure_file(cmake/package/copyright.in ${folder}/copyright @ONLY)
configure_file(cmake/package/changelog.Debian.in ${folder}/changelog.Debian @ONLY)
configure_file(CHANGELOG.md ${folder}/changelog COPYONLY)
file(CREATE_LINK copyright ${folder}/LICENSE SYMBOLIC) # to which the guide has links
install(FILES ${folder}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon-doc COMPONENT doc)
configure_file(cmake/package/triggers ${folder}/triggers COPYONLY)
file(CONFIGURE OUTPUT ${folder}/shlibs CONTENT "libgnomon 1 libgnomon1 (>= @PROJECT_VERSION@)\n")
foreach(file changelog changelog.Debian)
  execute_process(COMMAND gzip --best --no-name --keep --force ${folder}/${file})
endforeach()

include(CPack)
