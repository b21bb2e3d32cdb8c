# cmake -DSOURCE=… -DPROGRAM=… -DSCRATCH=… -DGENERATOR=… -DCXX=… -P bare_build.cmake
# Builds Gnomon without any optional part as a static library, and with Embree alone: the shared one is what ./check builds. It
# installs both, and builds and runs a program against each. The build's folder stays for the next time.
cmake_minimum_required(VERSION 3.25)
set(build ${SCRATCH}/build)
set(off)
foreach(library EMBREE QHULL LIBNOVA OSMESA EGL)
  list(APPEND off -DGNOMON_WITH_${library}=OFF)
endforeach()
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# expect_refusal(SENTENCE COMMAND...): it fails, and says the sentence, whatever the line breaks.
function(expect_refusal sentence)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  string(FIND "${said}" "${sentence}" place)
  if(status EQUAL 0 OR place EQUAL -1)
    message(FATAL_ERROR "\"${sentence}\" is not said with an error, but: ${said}")
  endif()
endfunction()

# install(KIND): into a folder of its own. `use` then configures a program against it.
function(install kind)
  set(installed ${SCRATCH}/${kind})
  file(REMOVE_RECURSE ${installed} ${SCRATCH}/program)
  run(${CMAKE_COMMAND} --build ${build} --target packaged)
  run(${CMAKE_COMMAND} --install ${build} --prefix ${installed})
  set(use ${CMAKE_COMMAND} -G ${GENERATOR} -S ${PROGRAM} -B ${SCRATCH}/program -DCMAKE_PREFIX_PATH=${installed}
    -DCMAKE_CXX_COMPILER=${CXX} PARENT_SCOPE)
endfunction()

# use_without_parts(KIND OPTION...): OPTION keeps from CMake what a machine lacks that has nothing but OpenSceneGraph and GLM.
function(use_without_parts kind)
  install(${kind})
  set(use ${use} PARENT_SCOPE)
  set(configure ${use} ${ARGN})
  expect_refusal("This Gnomon was built without Embree, which casts rays. Install libembree-dev, and build Gnomon with -DGNOMON_WITH_EMBREE=ON."
    ${configure} -DCOMPONENTS=traced)
  expect_refusal("This Gnomon was built without OSMesa, which draws without a display." ${configure} -DCOMPONENTS=headless)
  expect_refusal("There is no component rays. Allowed: traced, terrain, sun, headless, headless_egl."
    ${configure} -DCOMPONENTS=rays)
  run(${configure} -DCOMPONENTS=)
  run(${CMAKE_COMMAND} --build ${SCRATCH}/program)
  run(${SCRATCH}/program/bare)
endfunction()

set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=Debug
  -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DGNOMON_PROGRAMS=OFF -DGNOMON_TESTS=OFF)
file(REMOVE_RECURSE ${SCRATCH}/refused)
expect_refusal("GNOMON_WITH_EMBREE is ON, but Embree is not found. Install libembree-dev, or set -DGNOMON_WITH_EMBREE=AUTO."
  ${configure} -B ${SCRATCH}/refused -DGNOMON_WITH_EMBREE=ON -DCMAKE_DISABLE_FIND_PACKAGE_embree=ON)
expect_refusal("GNOMON_WITH_LIBNOVA is ON, but libnova is not found."
  ${configure} -B ${SCRATCH}/refused -DGNOMON_WITH_EMBREE=OFF -DGNOMON_WITH_LIBNOVA=ON -DNOVA_INCLUDE_DIR=OFF)
expect_refusal("Gnomon needs TBB::tbb. Install libtbb-dev." ${configure} -B ${SCRATCH}/refused -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON)
set(others)
foreach(package embree Qhull PkgConfig)
  list(APPEND others -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run(${configure} -B ${build} -DBUILD_SHARED_LIBS=OFF ${off})
use_without_parts(static ${others})
expect_refusal("This static Gnomon needs TBB::tbb. Install its library with headers." ${use} -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON)
run(${use} -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON -DOPTIONAL=ON)
run(${use} -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON -DOPTIONAL=OFF -DOWN_TBB=ON)

# A static library keeps to the Embree that it was built with, although another version is found first.
run(${configure} -B ${build} -DBUILD_SHARED_LIBS=OFF ${off} -DGNOMON_WITH_EMBREE=ON -Uembree_DIR)
load_cache(${build} READ_WITH_PREFIX found_ embree_DIR)
include(${found_embree_DIR}/embree-config-version.cmake)
string(REGEX MATCH "^[34]" version ${PACKAGE_VERSION})
math(EXPR other "7 - ${version}")
set(other_embree ${SCRATCH}/embrees/other/lib/cmake/embree)
file(WRITE ${other_embree}/embree-config-version.cmake
  "set(PACKAGE_VERSION ${other}.0.0)\nif(PACKAGE_FIND_VERSION_MAJOR STREQUAL ${other})\n  set(PACKAGE_VERSION_COMPATIBLE ON)\nendif()\n")
file(WRITE ${other_embree}/embree-config.cmake "message(FATAL_ERROR \"Embree ${other} is taken.\")\n")
file(WRITE ${SCRATCH}/embrees/same/embree-config-version.cmake "include(${found_embree_DIR}/embree-config-version.cmake)\n")
file(WRITE ${SCRATCH}/embrees/same/embree-config.cmake "include(${found_embree_DIR}/embree-config.cmake)\n")
function(expect_embree_dir folder binary)
  load_cache(${binary} READ_WITH_PREFIX kept_ embree_DIR)
  if(NOT kept_embree_DIR STREQUAL folder)
    message(FATAL_ERROR "embree_DIR of ${binary} is ${kept_embree_DIR}, and no longer ${folder}.")
  endif()
endfunction()
run(${configure} -B ${build} -Dembree_DIR=${SCRATCH}/embrees/same)
expect_embree_dir(${SCRATCH}/embrees/same ${build})
install(traced)
set(ENV{CMAKE_PREFIX_PATH} ${SCRATCH}/embrees/other)
run(${use} -DCOMPONENTS=traced)
expect_embree_dir(${found_embree_DIR} ${SCRATCH}/program)
run(${use} -Dembree_DIR=${other_embree} -DCOMPONENTS=traced)
expect_embree_dir(${found_embree_DIR} ${SCRATCH}/program)
run(${use} -Dembree_DIR=${SCRATCH}/embrees/same -DCOMPONENTS=traced)
expect_embree_dir(${SCRATCH}/embrees/same ${SCRATCH}/program)
run(${CMAKE_COMMAND} --build ${SCRATCH}/program)
run(${SCRATCH}/program/rays)
