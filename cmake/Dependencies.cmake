# Imported targets for what FindOpenSceneGraph gives only as paths, and for OSMesa. Headers are SYSTEM: their warnings are not ours.
find_package(glm REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(embree 3 CONFIG REQUIRED)
find_package(Qhull CONFIG REQUIRED)
find_package(hwy CONFIG REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS OpenGL GLX EGL)
find_package(OpenSceneGraph 3.6.5 REQUIRED COMPONENTS osg osgUtil osgDB osgFX osgGA osgText osgViewer osgShadow osgTerrain)
find_package(PkgConfig REQUIRED)
pkg_check_modules(OSMESA REQUIRED osmesa)
find_path(NOVA_INCLUDE_DIR libnova/solar.h REQUIRED)
find_library(NOVA_LIBRARY nova REQUIRED)

function(gnomon_import_osg kit)
  string(TOUPPER ${kit} upper)
  add_library(osg::${kit} INTERFACE IMPORTED)
  set_target_properties(osg::${kit} PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${${upper}_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${${upper}_LIBRARY}")
endfunction()
foreach(kit osg osgUtil osgDB osgFX osgGA osgText osgViewer osgShadow osgTerrain)
  gnomon_import_osg(${kit})
endforeach()
string(TOUPPER OpenThreads upper)
add_library(osg::OpenThreads INTERFACE IMPORTED)
set_target_properties(osg::OpenThreads PROPERTIES INTERFACE_LINK_LIBRARIES "${OPENTHREADS_LIBRARY}")
target_link_libraries(osg::osg INTERFACE osg::OpenThreads)

# libOSMesa must come before libGL in a program's list of libraries: libosg looks its GL functions up by name in that order.
# Options stand ahead of all libraries, whatever the order in target_link_libraries().
add_library(osmesa::osmesa INTERFACE IMPORTED)
set_target_properties(osmesa::osmesa PROPERTIES
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OSMESA_INCLUDE_DIRS}"
  INTERFACE_LINK_OPTIONS "LINKER:--push-state,--no-as-needed,-lOSMesa,--pop-state")

# libnova brings neither a package file nor a pkg-config file.
add_library(nova::nova INTERFACE IMPORTED)
set_target_properties(nova::nova PROPERTIES
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${NOVA_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES "${NOVA_LIBRARY}")
