# cmake -DSOURCE=… -DPROGRAM=… -DSCRATCH=… -DGENERATOR=… -DCXX=… -P bare_build.cmake
# Builds Gnomon without any optional part, as a shared and as a static library, installs both, and builds and runs a program
# against each. The build's folder stays for the next time.
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

# install_and_use(KIND OPTION...): with what CMake needs for a program on a machine that has nothing but OpenSceneGraph and GLM.
function(install_and_use kind)
  set(installed ${SCRATCH}/${kind})
  file(REMOVE_RECURSE ${installed} ${SCRATCH}/program)
  run(${CMAKE_COMMAND} --build ${build} --target packaged)
  run(${CMAKE_COMMAND} --install ${build} --prefix ${installed})
  set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -S ${PROGRAM} -B ${SCRATCH}/program -DCMAKE_PREFIX_PATH=${installed}
    -DCMAKE_CXX_COMPILER=${CXX} ${ARGN})
  expect_refusal("This Gnomon was built without Embree, which casts rays. Install libembree-dev, and build Gnomon with -DGNOMON_WITH_EMBREE=ON."
    ${configure} -DCOMPONENTS=traced)
  expect_refusal("This Gnomon was built without OSMesa, which draws without a display." ${configure} -DCOMPONENTS=headless)
  expect_refusal("There is no component rays. Allowed: metrics, traced, terrain, sun, headless, headless_egl."
    ${configure} -DCOMPONENTS=rays)
  run(${configure} -DCOMPONENTS=)
  run(${CMAKE_COMMAND} --build ${SCRATCH}/program)
  file(GLOB_RECURSE library ${installed}/*/libgnomon.*)
  list(GET library 0 library)
  get_filename_component(library ${library} DIRECTORY)
  run(${CMAKE_COMMAND} -E env OSG_LIBRARY_PATH=${library} ${SCRATCH}/program/bare)
endfunction()

set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=Debug
  -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DGNOMON_PROGRAMS=OFF -DGNOMON_TESTS=OFF)
expect_refusal("GNOMON_WITH_EMBREE is ON, but Embree is not found. Install libembree-dev, or set -DGNOMON_WITH_EMBREE=AUTO."
  ${configure} -B ${SCRATCH}/refused -DGNOMON_WITH_EMBREE=ON -DCMAKE_DISABLE_FIND_PACKAGE_embree=ON)
set(others)
foreach(package embree TBB hwy Qhull PkgConfig OpenGL)
  list(APPEND others -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run(${configure} -B ${build} -DBUILD_SHARED_LIBS=ON ${off})
install_and_use(shared ${others})
run(${configure} -B ${build} -DBUILD_SHARED_LIBS=OFF ${off})
install_and_use(static)
