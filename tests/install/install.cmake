# Installs the build tree BUILD afresh into WORK/prefix; WORK is emptied first, so that nothing of an earlier run is found.
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix COMMAND_ERROR_IS_FATAL ANY)
