#include "sdf/script/context.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <lua.hpp>

#include "sdf/script/library.h"

namespace sdf {

namespace {

constexpr int kHookInterval = 1000;

// --- limits ---

struct Owner {
  ScriptContext* context;
  lua_State* state;
};

// Counts what Lua holds and refuses what goes past the limit; Lua then collects garbage and asks once more.
void* allocate(void* owner, void* block, std::size_t oldSize, std::size_t newSize) {
  const auto& [context, state] = *static_cast<Owner*>(owner);
  if (!block) oldSize = 0;  // Lua passes the kind of object here
  if (newSize == 0) {
    context->bytes -= oldSize;
    std::free(block);
    return nullptr;
  }
  const std::size_t after = context->bytes - oldSize + newSize;
  const auto graph = static_cast<std::size_t>(std::max<std::int64_t>(context->nodes.held(), 0)) * kNodeBytes;
  if (newSize > oldSize && after + graph > context->options.memoryLimit) {
    context->refused = true;
    if (const int line = state ? currentLine(state) : 0) context->refusedLine = line;
    return nullptr;
  }
  void* moved = std::realloc(block, newSize);
  if (moved) context->bytes = after;
  return moved;
}

// pcall can swallow the error, so from here on every instruction raises it again.
void repeatError(lua_State* L, lua_Debug*) { raise(L, contextOf(L).exceeded); }

[[noreturn]] void endRun(lua_State* L, const std::string& message) {
  ScriptContext& c = contextOf(L);
  c.exceeded = message;
  c.exceededLine = currentLine(L);
  lua_sethook(L, repeatError, LUA_MASKCOUNT, 1);
  raise(L, message);
}

void checkTime(lua_State* L) {
  const ScriptContext& c = contextOf(L);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - c.start;
  if (passed.count() <= c.options.timeLimit) return;
  const std::string longer = "ran longer than " + shown(c.options.timeLimit) + " seconds";
  if (2.0 * c.slowestRead > passed)
    endRun(L, longer + ", most of them to read '" + c.slowestMesh + "'; give it fewer triangles");
  endRun(L, longer + "; look for a loop near line " + std::to_string(currentLine(L)));
}

void countInstructions(lua_State* L, lua_Debug*) {
  ScriptContext& c = contextOf(L);
  c.instructions += kHookInterval;
  if (c.instructions > c.options.instructionLimit)
    endRun(L, "ran more than " + shown(static_cast<double>(c.options.instructionLimit) / 1e6) +
                  " million instructions; look for an endless loop near line " +
                  std::to_string(currentLine(L)));
  checkTime(L);
}

// --- running ---

std::string placeOf(const std::string& file, int line) {
  return line > 0 ? file + ":" + std::to_string(line) : file;
}

// Runs where the error arose: gives it a place if it has none.
int addPlace(lua_State* L) {
  const bool text = lua_type(L, 1) == LUA_TSTRING;
  std::string message = text ? textAt(L, 1) : "error was given " + describe(L, 1) + "; give it a text";
  if (message.ends_with("stack overflow")) message += "; look for a function that calls itself without end";
  if (message.find("a formula value") != std::string::npos || message.ends_with("got formula)"))
    message += "; value(k) gives the present value of a parameter k";
  const ScriptContext& c = contextOf(L);
  if (!message.starts_with(c.shortName + ":"))
    message = placeOf(c.shortName, currentLine(L)) + ": " + message;
  lua_pushlstring(L, message.data(), message.size());
  return 1;
}

// Shapes that the script returned are parts without names.
int addReturned(lua_State* L) {
  ScriptContext& c = contextOf(L);
  const int count = lua_gettop(L);
  for (int i = 1; i <= count; ++i) {
    const Shape* shape = testShape(L, i);
    if (!shape && count == 1 && lua_isnil(L, i)) return 0;
    if (!shape) raise(L, "the script must return shapes, returned " + describe(L, i));
    if (shape->dimension != 3) raise(L, "the shape that the script returns is flat; extrude or revolve it");
    if (isMissing(*shape)) continue;
    std::string name;
    for (std::size_t number = c.scene.parts.size() + 1; name.empty(); ++number)
      if (std::string free = "part " + std::to_string(number); c.partNames.insert(free).second)
        name = std::move(free);
    c.scene.add(std::move(name), *shape);
  }
  return 0;
}

// One line for a terminal: without what moves its cursor or changes its colours, and no longer than a page.
std::string oneLine(std::string text) {
  std::size_t most = 2000;
  if (text.size() > most) {
    while ((text[most] & 0xc0) == 0x80) --most;  // within a letter of UTF-8
    text = text.substr(0, most) + " …";
  }
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  return text;
}

class Sandbox {
 public:
  explicit Sandbox(ScriptContext& context) : context_(context), owner_{&context, nullptr} {
    state_ = lua_newstate(allocate, &owner_);
    if (!state_) return;
    owner_.state = state_;
    *static_cast<ScriptContext**>(lua_getextraspace(state_)) = &context;
  }
  ~Sandbox() {
    owner_.state = nullptr;
    if (state_) lua_close(state_);
  }
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  Status run(const std::string& text) {
    if (!state_) return outOfMemory();
    lua_pushcfunction(state_, openLanguage);
    if (const int status = lua_pcall(state_, 0, 0, 0)) return failure(status);
    context_.nodesAtCollection = context_.nodes.held();
    const std::string chunk = "@" + context_.shortName;
    lua_pushcfunction(state_, addPlace);
    if (const int status = luaL_loadbufferx(state_, text.data(), text.size(), chunk.c_str(), "t"))
      return failure(status);
    lua_sethook(state_, countInstructions, LUA_MASKCOUNT, kHookInterval);
    int status = lua_pcall(state_, 0, LUA_MULTRET, 1);
    lua_sethook(state_, nullptr, 0, 0);
    if (!context_.exceeded.empty() || status) return failure(status);
    lua_pushcfunction(state_, addReturned);
    lua_insert(state_, 2);
    status = lua_pcall(state_, lua_gettop(state_) - 2, 0, 1);
    return status ? failure(status) : okStatus();
  }

 private:
  Error error(int line, const std::string& message) const {
    return {ErrorKind::Scene, oneLine(placeOf(context_.file, line) + ": " + message)};
  }
  Error outOfMemory() const {
    return error(context_.refusedLine, "needed more than " +
                                           std::to_string(context_.options.memoryLimit >> 20) +
                                           " MiB of memory; look for what grows without end");
  }

  // The message on the top of the stack, or what is known better.
  Error failure(int status) const {
    if (!context_.exceeded.empty()) return error(context_.exceededLine, context_.exceeded);
    const std::string message =
        lua_type(state_, -1) == LUA_TSTRING ? textAt(state_, -1) : "the script failed";
    if (status == LUA_ERRMEM || (context_.refused && message.ends_with("not enough memory")))
      return outOfMemory();
    const std::string& name = context_.shortName;
    if (!message.starts_with(name + ":")) return error(0, message);
    return {ErrorKind::Scene, oneLine(context_.file + message.substr(name.size()))};
  }

  ScriptContext& context_;
  Owner owner_;
  lua_State* state_ = nullptr;
};

}  // namespace

ScriptContext& contextOf(lua_State* L) { return **static_cast<ScriptContext**>(lua_getextraspace(L)); }

void checkLimits(lua_State* L) {
  ScriptContext& c = contextOf(L);
  if (!c.exceeded.empty()) raise(L, c.exceeded);
  checkTime(L);
  // Lua sees only the handles of a graph, and would let a large one wait too long.
  constexpr std::int64_t kShare = 8;
  const auto limit = static_cast<std::int64_t>(c.options.memoryLimit / kNodeBytes);
  if (c.nodes.held() < c.nodesAtCollection + limit / kShare) return;
  lua_gc(L, LUA_GCCOLLECT);
  c.nodesAtCollection = c.nodes.held();
}

Status runInSandbox(ScriptContext& context, const std::string& text) {
  constexpr std::size_t kLongest = 40;  // Lua cuts chunk names at 60
  context.shortName = std::filesystem::path(context.file).filename().string();
  if (context.shortName.empty() || context.shortName.size() > kLongest) context.shortName = "scene.lua";
  Sandbox sandbox(context);
  return sandbox.run(text);
}

}  // namespace sdf
