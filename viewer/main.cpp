#include <iostream>

#include "command_line/memory.h"
#include "viewer/app/window.h"
#include "viewer/headless.h"
#include "viewer/options.h"

namespace {

/// Prints the error and returns the exit status for it. A driver's log has lines of its own.
int fail(const sdf::Error& error) {
  std::cerr << "sdfview: " << error.message << std::endl;
  return static_cast<int>(error.kind);
}

sdf::Status run(const sdf::viewer::Options& o) {
  if (o.picture || o.bench || o.glsl) return sdf::viewer::runHeadless(o, std::cout);
  return sdf::viewer::runWindow({o.scene, {o}, o.width, o.height, o.fit});
}

}  // namespace

int main(int argc, char** argv) {
  sdf::command_line::endWhereMemoryEnds("sdfview",
                                        "take smaller pictures, meshes of fewer voxels, or fewer shapes");
  auto parsed = sdf::viewer::parseOptions(argc, argv);
  if (!parsed) return fail(parsed.error());
  if (const auto* answer = std::get_if<sdf::command_line::Answer>(&*parsed)) {
    std::cout << answer->text;
    return 0;
  }
  const sdf::Status done = run(std::get<sdf::viewer::Options>(*parsed));
  return done ? 0 : fail(done.error());
}
