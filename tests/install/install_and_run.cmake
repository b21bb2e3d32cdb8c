# cmake -DBUILD=… -DPROGRAM=… -DSCRATCH=… -DGENERATOR=… -P install_and_run.cmake
file(REMOVE_RECURSE ${SCRATCH})
foreach(step
    "${CMAKE_COMMAND};--install;${BUILD};--prefix;${SCRATCH}/installed"
    "${CMAKE_COMMAND};-G;${GENERATOR};-S;${PROGRAM};-B;${SCRATCH}/build;-DCMAKE_PREFIX_PATH=${SCRATCH}/installed"
    "${CMAKE_COMMAND};--build;${SCRATCH}/build"
    "${SCRATCH}/build/headless_first"
    "${SCRATCH}/build/headless_last")
  execute_process(COMMAND ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
