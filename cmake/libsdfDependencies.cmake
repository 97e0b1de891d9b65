# What sdf::core and sdf::mesh are linked with. Read by this project's own build and by the installed libsdfConfig.cmake,
# so that both look for the same things in the same order.

# sdf_find_dependencies(<core|mesh> <out>): finds the packages that one library needs and sets <out> to those missing.
# A function, so that the module path and the quiet message level end with it; imported targets outlive it.
function(sdf_find_dependencies component out)
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  set(missing)
  if(component STREQUAL "core")
    find_package(glm QUIET)
    find_package(hwy QUIET)
    # The C++ build of Lua: its errors unwind the stack as exceptions do; the C build's jump over destructors.
    find_package(PkgConfig QUIET)
    if(PkgConfig_FOUND)
      pkg_check_modules(SDF_LUA QUIET IMPORTED_TARGET lua5.4-c++)
      pkg_check_modules(SDF_FONTS QUIET IMPORTED_TARGET freetype2 harfbuzz fontconfig)
    endif()
    find_package(pugixml CONFIG QUIET)
    find_package(TinyGLTF CONFIG QUIET)
    find_package(meshoptimizer CONFIG QUIET)
    foreach(package glm hwy PkgConfig SDF_LUA SDF_FONTS pugixml TinyGLTF meshoptimizer)
      if(NOT ${package}_FOUND)
        list(APPEND missing ${package})
      endif()
    endforeach()
  elseif(component STREQUAL "mesh")
    # TBB first: OpenVDB's own FindTBB makes only TBB::tbb and breaks later look-ups.
    find_package(TBB CONFIG QUIET)
    # OpenVDB ships a finder, not a config file, and not on the default module path.
    foreach(prefix ${CMAKE_PREFIX_PATH} /usr/local /usr)
      list(APPEND CMAKE_MODULE_PATH ${prefix}/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB
                                    ${prefix}/lib/cmake/OpenVDB)
    endforeach()
    find_package(OpenVDB 10 QUIET)
    find_package(OpenMesh CONFIG QUIET)
    foreach(package TBB OpenVDB OpenMesh)
      if(NOT ${package}_FOUND)
        list(APPEND missing ${package})
      endif()
    endforeach()
  endif()
  list(TRANSFORM missing REPLACE "^SDF_LUA$" "lua5.4-c++")
  list(TRANSFORM missing REPLACE "^SDF_FONTS$" "freetype2, harfbuzz, fontconfig")
  set(${out} "${missing}" PARENT_SCOPE)
endfunction()
