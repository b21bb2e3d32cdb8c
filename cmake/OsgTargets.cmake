# Imported targets for what FindOpenSceneGraph has found, which gives only paths. Headers are SYSTEM: their warnings are not ours.
function(gnomon_import_osg kit)
  string(TOUPPER ${kit} upper)
  if(TARGET osg::${kit} OR NOT ${upper}_FOUND)
    return()
  endif()
  add_library(osg::${kit} INTERFACE IMPORTED)
  set_target_properties(osg::${kit} PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${${upper}_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${${upper}_LIBRARY}")
endfunction()
foreach(kit OpenThreads osg osgUtil osgAnimation osgDB osgFX osgGA osgText osgViewer osgShadow osgTerrain)
  gnomon_import_osg(${kit})
endforeach()
target_link_libraries(osg::osg INTERFACE osg::OpenThreads)
