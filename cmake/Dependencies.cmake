# What Gnomon is built with. Programs that use the installed shared library need OpenSceneGraph and GLM alone; those
# with a static one need MathLibraries.cmake besides.
find_package(glm REQUIRED)
find_package(OpenSceneGraph 3.6.5 REQUIRED COMPONENTS osg osgUtil osgDB osgFX osgGA osgText osgViewer osgShadow osgTerrain)
include(${CMAKE_CURRENT_LIST_DIR}/OsgTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/MathLibraries.cmake)
find_package(OpenGL REQUIRED COMPONENTS OpenGL GLX OPTIONAL_COMPONENTS EGL)
include(${CMAKE_CURRENT_LIST_DIR}/OSMesa.cmake)

include(${CMAKE_CURRENT_LIST_DIR}/OptionalParts.cmake)
gnomon_optional_part(traced Embree embree_FOUND libembree-dev "casts rays")
gnomon_optional_part(terrain Qhull Qhull_FOUND libqhull-dev "cuts casters into convex parts for shadows on terrain")
gnomon_optional_part(sun libnova NOVA_LIBRARY libnova-dev "knows where the sun stands")
gnomon_optional_part(headless OSMesa OSMESA_FOUND libosmesa6-dev "draws without a display")
gnomon_optional_part(headless_egl EGL OpenGL_EGL_FOUND libegl-dev "draws without a display on a GPU")
