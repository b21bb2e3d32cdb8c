# cmake -DBUILD=… -DPROGRAM=… -DPLAIN=… -DSCRATCH=… -DGENERATOR=… -DCXX=… -P install_and_run.cmake
cmake_minimum_required(VERSION 3.20)
file(REMOVE_RECURSE ${SCRATCH})
set(installed ${SCRATCH}/installed)
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

unset(ENV{OSG_LIBRARY_PATH}) # the library names its plugins' folder itself; OpenSceneGraph looks into these two
unset(ENV{LD_LIBRARY_PATH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${installed})

# Programs against what lies there, linked in either order.
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${PROGRAM} -B ${SCRATCH}/build -DCMAKE_PREFIX_PATH=${installed})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/headless_first)
run(${SCRATCH}/build/headless_last)

# The same by pkg-config.
file(GLOB_RECURSE package ${installed}/*/gnomon.pc)
get_filename_component(package ${package} DIRECTORY)
get_filename_component(libraries ${package} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${package})
run(sh -c "eval \"'${CXX}' -std=c++17 '${PLAIN}/main.cpp' $(pkg-config --cflags --libs gnomon) '-Wl,-rpath,${libraries}' -o '${SCRATCH}/plain'\"")
run(${SCRATCH}/plain WORKING_DIRECTORY ${SCRATCH})

# The guide is there with its pictures: what a page has a link to lies beside it.
file(GLOB_RECURSE pages ${installed}/*.md)
foreach(page ${pages})
  get_filename_component(folder ${page} DIRECTORY)
  file(READ ${page} text)
  string(REPLACE "](" "\r" text "${text}") # a list of CMake's takes no single bracket
  string(REGEX MATCHALL "\r[^ ):#]+[)#]" links "${text}")
  foreach(link ${links})
    string(REGEX REPLACE "^.(.*).$" "\\1" link ${link})
    if(NOT EXISTS ${folder}/${link})
      message(FATAL_ERROR "${page} has a link to ${link}, which is not installed.")
    endif()
  endforeach()
endforeach()
list(LENGTH pages count)
if(count LESS 24)
  message(FATAL_ERROR "The guide has ${count} pages.")
endif()

# Examples build as they lie there.
foreach(example addshadows owntechnique tutorial)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${installed}/share/doc/gnomon-doc/examples/${example} -B ${SCRATCH}/${example}
    -DCMAKE_PREFIX_PATH=${installed})
  run(${CMAKE_COMMAND} --build ${SCRATCH}/${example})
endforeach()

# Each program runs from where it lies, and has a page for man and completion.
file(GLOB programs RELATIVE ${installed}/bin ${installed}/bin/*)
if(NOT "gnomonshot" IN_LIST programs)
  message(FATAL_ERROR "gnomonshot is not installed, only: ${programs}")
endif()
foreach(program ${programs})
  run(${installed}/bin/${program} --help OUTPUT_QUIET)
  foreach(file man/man1/${program}.1.gz bash-completion/completions/${program})
    if(NOT EXISTS ${installed}/share/${file})
      message(FATAL_ERROR "${file} is missing.")
    endif()
  endforeach()
endforeach()

# They find the plugins beside them, and so the nodes of Gnomon's own scenes.
execute_process(COMMAND ${installed}/bin/gnomonshot ${installed}/share/gnomon/halomagic.osgt --size 80x60 --out ${SCRATCH}/halomagic.png
  ERROR_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(said MATCHES "plugin")
  message(FATAL_ERROR "gnomonshot says: ${said}")
endif()
execute_process(COMMAND bash -c
  "source '${installed}/share/bash-completion/completions/gnomonshot'
   COMP_WORDS=('${installed}/bin/gnomonshot' --shadow tr) COMP_CWORD=2; _gnomon '${installed}/bin/gnomonshot'; echo \"\${COMPREPLY[@]}\"
   COMP_WORDS=('${installed}/bin/gnomonshot' --fov) COMP_CWORD=1; _gnomon '${installed}/bin/gnomonshot'; echo \"\${COMPREPLY[@]}\""
  OUTPUT_VARIABLE completed COMMAND_ERROR_IS_FATAL ANY)
if(NOT completed STREQUAL "traced\n--fovy\n")
  message(FATAL_ERROR "bash completes to: ${completed}")
endif()
