// Tubes and struts along lines in space. Private to script/.
#pragma once

struct lua_State;

namespace sdf {

/// tube({{x, y, z}, …}, radius, {curve = …}). A LibraryFunction.
int tubeShape(lua_State* L);
/// struts({{x, y, z}, …}, {{1, 2}, …}, radius). A LibraryFunction.
int strutsShape(lua_State* L);

}  // namespace sdf
