// One run of a scene script: the names in its reach, its limits, and its state: the scene so far, and the
// inputs that it has asked for.
#pragma once
#include <chrono>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

#include "sdf/expr/expr.h"
#include "sdf/model/offset_check.h"
#include "sdf/scene/scene.h"
#include "sdf/script/script.h"

struct lua_State;

namespace sdf {

/// An offset of a shape whose distance is not exact, which may go wrong.
struct OffsetNote {
  std::string place;   ///< of the call, "scene.lua:3: round"
  std::string reader;  ///< what the figures are those of, "the surface"
  std::string since;   ///< what made the distance inexact, "field in line 1"
  OffsetToCheck offset;
};

struct ScriptContext {
  ScriptContext(std::string fileName, const ScriptOptions& scriptOptions)
      : file(std::move(fileName)),
        options(scriptOptions),
        nodes(static_cast<std::int64_t>(scriptOptions.memoryLimit / kNodeBytes)) {}

  std::string file;       ///< as messages name it
  std::string shortName;  ///< as Lua's own messages name it (Lua cuts long names)
  ScriptOptions options;
  Scene scene;
  std::map<std::string, int> settingLines;  ///< settings made so far, and where
  std::map<std::string, double> parameterDefaults;
  std::unordered_set<std::string> partNames;  ///< of those made so far
  int materials = 0;                          ///< made so far
  std::vector<OffsetNote> offsets;            ///< to be looked at when the scene is made
  std::set<std::string> toNarrow;  ///< inputs for whose present values alone the script is to run again

  NodeLimit nodes;
  std::int64_t nodesAtCollection = 0;
  std::size_t bytes = 0;  ///< held by Lua
  bool refused = false;   ///< Lua was denied memory …
  int refusedLine = 0;    ///< … last while this line ran
  std::uint64_t instructions = 0;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::string slowestMesh;                         ///< of those read so far, the one that took longest, …
  std::chrono::duration<double> slowestRead{0.0};  ///< … and how long
  std::string exceeded;  ///< the message of the limit that ended the run; "" while it goes on
  int exceededLine = 0;
};

/// The formula that stands for this parameter, as the options want it.
Expr inputOf(const ScriptContext& context, ParameterInfo info);

/// Notes that the script reads the present values of the inputs of a formula, and returns their names.
std::set<std::string> noteValuesRead(ScriptContext& context, const Expr& e);

/// The context of the script that runs in this state.
ScriptContext& contextOf(lua_State* L);

/// Runs `text` with the scene language's functions in reach and nothing else, and fills context.scene. The
/// error names file and line. Shapes that the script returns become unnamed parts.
Status runInSandbox(ScriptContext& context, const std::string& text);

/// Adds a text to a list that lacks it.
void addOnce(std::vector<std::string>& all, const std::string& one);
/// Pushes a shape that stands for what a file would have given, and notes that it is missing; or ends the
/// script with the reason, unless ScriptOptions::withoutMissing. Returns 1, the number of results.
int pushMissing(lua_State* L, const std::string& why);

/// Ends the run if it has taken too long; collects garbage when dropped graphs have piled up. Every library
/// function calls it, for one call can do the work of many instructions.
void checkLimits(lua_State* L);

}  // namespace sdf
