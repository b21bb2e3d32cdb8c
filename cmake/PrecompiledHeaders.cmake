# gnomon_precompile(TARGET KIND) compiles the headers that most files include once for all targets of a kind, instead of
# once a file. KIND is
#   maths       the standard library and GLM
#   osg         these and OpenSceneGraph
#   program     these and osgViewer
#   maths_test  the standard library, GLM and GoogleTest, for targets that link it
#   test        these, OpenSceneGraph and osgViewer
# A kind with more headers costs each file more: templates that a header names are compiled anew for it.
# Call it after all that is said of how the target is compiled. gnomon_precompile_folder(KIND) does so for all targets of
# this folder and those below that have no kind yet.
# Files include what they use all the same: with GNOMON_PRECOMPILE=OFF they compile, too.
option(GNOMON_PRECOMPILE "Compile common headers once for many files" ON)

set(gnomon_headers_maths
  <algorithm> <array> <cmath> <cstdint> <cstring> <functional> <iostream> <limits> <map> <memory> <numeric> <optional>
  <random> <set> <sstream> <stdexcept> <string> <tuple> <unordered_map> <utility> <vector>
  <glm/glm.hpp> <glm/gtc/matrix_access.hpp> <glm/gtc/matrix_transform.hpp> <glm/gtc/type_ptr.hpp>)
set(gnomon_headers_maths_test ${gnomon_headers_maths} <gtest/gtest.h>)
set(gnomon_headers_osg
  ${gnomon_headers_maths}
  <osg/Geode> <osg/Geometry> <osg/GLExtensions> <osg/LightSource> <osg/Material> <osg/MatrixTransform> <osg/Program>
  <osg/State> <osg/Texture2D> <osgUtil/CullVisitor>)
set(gnomon_headers_program ${gnomon_headers_osg} <filesystem> <osgDB/ReadFile> <osgViewer/Viewer>)
set(gnomon_headers_test ${gnomon_headers_program} <gtest/gtest.h>)
set(gnomon_headers_libraries_maths glm::glm)
set(gnomon_headers_libraries_maths_test glm::glm GTest::gtest)
set(gnomon_headers_libraries_osg glm::glm osg::osgUtil osg::osg)
set(gnomon_headers_libraries_program
  glm::glm osg::osgViewer osg::osgGA osg::osgUtil osg::osgDB osg::osg)
set(gnomon_headers_libraries_test ${gnomon_headers_libraries_program} GTest::gtest)

# What is compiled once suits a target only if both are compiled alike: these properties are its, too, and name it.
function(gnomon_headers_target result target kind)
  get_target_property(type ${target} TYPE)
  get_target_property(POSITION_INDEPENDENT_CODE ${target} POSITION_INDEPENDENT_CODE)
  if(type MATCHES "SHARED_LIBRARY|MODULE_LIBRARY")
    set(POSITION_INDEPENDENT_CODE ON)
  endif()
  get_target_property(COMPILE_OPTIONS ${target} COMPILE_OPTIONS)
  get_target_property(CXX_VISIBILITY_PRESET ${target} CXX_VISIBILITY_PRESET)
  get_target_property(VISIBILITY_INLINES_HIDDEN ${target} VISIBILITY_INLINES_HIDDEN)
  set(properties)
  foreach(property POSITION_INDEPENDENT_CODE COMPILE_OPTIONS CXX_VISIBILITY_PRESET VISIBILITY_INLINES_HIDDEN)
    if(${property})
      list(APPEND properties ${property} "${${property}}")
    endif()
  endforeach()
  set(name gnomon_headers_${kind})
  if(properties)
    string(MD5 hash "${properties}")
    string(SUBSTRING ${hash} 0 6 hash)
    string(APPEND name _${hash})
  endif()
  set(${result} ${name} PARENT_SCOPE)
  if(TARGET ${name})
    return()
  endif()
  set(source ${PROJECT_BINARY_DIR}/headers/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Made by CMake: a library needs a file.\n")
  add_library(${name} OBJECT ${source})
  foreach(property POSITION_INDEPENDENT_CODE COMPILE_OPTIONS CXX_VISIBILITY_PRESET VISIBILITY_INLINES_HIDDEN)
    if(${property})
      set_property(TARGET ${name} PROPERTY ${property} ${${property}})
    endif()
  endforeach()
  target_link_libraries(${name} PRIVATE ${gnomon_headers_libraries_${kind}} gnomon_warnings)
  target_precompile_headers(${name} PRIVATE ${gnomon_headers_${kind}})
endfunction()

function(gnomon_precompile target kind)
  if(GNOMON_PRECOMPILE)
    gnomon_headers_target(headers ${target} ${kind})
    target_precompile_headers(${target} REUSE_FROM ${headers})
  endif()
endfunction()

function(gnomon_precompile_folder kind)
  set(folders ${CMAKE_CURRENT_SOURCE_DIR})
  while(folders)
    list(POP_FRONT folders folder)
    get_property(below DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
    list(APPEND folders ${below})
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target ${targets})
      get_target_property(type ${target} TYPE)
      get_target_property(reused ${target} PRECOMPILE_HEADERS_REUSE_FROM)
      get_target_property(own ${target} PRECOMPILE_HEADERS)
      if(type MATCHES "EXECUTABLE|LIBRARY" AND NOT type STREQUAL INTERFACE_LIBRARY AND NOT reused AND NOT own)
        gnomon_precompile(${target} ${kind})
      endif()
    endforeach()
  endwhile()
endfunction()
