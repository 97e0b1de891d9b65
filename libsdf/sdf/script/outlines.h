// Flat shapes of outlines: text, paths and drawings. Private to script/.
#pragma once

struct lua_State;

namespace sdf {

/// text("…", {font = …}). A LibraryFunction.
int textShape(lua_State* L);
/// path("M 0 0 L …"). A LibraryFunction.
int pathShape(lua_State* L);
/// svg("logo.svg", {size = …}). A LibraryFunction.
int svgShape(lua_State* L);

}  // namespace sdf
