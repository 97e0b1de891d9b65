# Headers of others that most files include, compiled once for each set of flags: they are half of what most files cost.
# None of ours, so that a change recompiles only what includes it. Files still include all they use: the preset fuzz, which
# has nothing precompiled, would tell, and so does CMAKE_DISABLE_PRECOMPILE_HEADERS=ON.
set(precompiled_headers
    <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers> <optional>
    <random> <set> <span> <sstream> <string> <string_view> <unordered_map> <utility> <variant> <vector>
    <glm/common.hpp> <glm/geometric.hpp> <glm/trigonometric.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <glm/vec4.hpp>)

# sdf_precompiled(<name> [<more headers…>]): a target for others to share by sdf_precompile. It must be compiled with their
# flags; GCC warns where it is not, and then does without.
function(sdf_precompiled name)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE glm::glm)
  target_precompile_headers(${name} PRIVATE ${precompiled_headers} ${ARGN})
endfunction()

# sdf_precompile(<precompiled> <targets…>)
function(sdf_precompile precompiled)
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM ${precompiled})
    # What GCC 12 says of std::string's own code (its bug 105651) under two more names, once it is precompiled.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13
       AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
      target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow)
    endif()
  endforeach()
endfunction()

# sdf_unity(<targets…>): compiles the files of each folder as one where SDF_UNITY says so, which takes half the time. Names in
# unnamed namespaces must then differ within a folder.
function(sdf_unity)
  if(NOT SDF_UNITY)
    return()
  endif()
  foreach(target ${ARGN})
    get_target_property(sources ${target} SOURCES)
    foreach(source ${sources})
      cmake_path(ABSOLUTE_PATH source NORMALIZE)
      cmake_path(GET source PARENT_PATH folder)
      cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      string(MAKE_C_IDENTIFIER ${folder} group)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # To GCC, a file that is included is a header, whose classes must not use names of unnamed namespaces.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endforeach()
endfunction()
