# Exports the scene of README with the installed program SDF2GLTF.
include(${CMAKE_CURRENT_LIST_DIR}/snippet.cmake)
write_snippet(${README} lua ${WORK}/readme.lua)
execute_process(COMMAND ${SDF2GLTF} ${WORK}/readme.lua -o ${WORK}/readme.glb COMMAND_ERROR_IS_FATAL ANY)
if(NOT EXISTS ${WORK}/readme.glb)
  message(FATAL_ERROR "sdf2gltf said that it was done, but wrote no ${WORK}/readme.glb")
endif()
