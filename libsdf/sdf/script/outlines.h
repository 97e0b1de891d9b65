// Flat shapes of outlines: text. Private to script/.
#pragma once

struct lua_State;

namespace sdf {

/// text("…", {font = …}). A LibraryFunction.
int textShape(lua_State* L);

}  // namespace sdf
