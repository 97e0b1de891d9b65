// What stands for OpenGL where the viewer is not built: failures that say so.
#include "drawn_rays.h"
#include "shader_reading.h"

namespace sdf::chart {

namespace {

[[noreturn]] void refuse() {
  throw std::runtime_error("sdfchart was built without the viewer, for want of what it needs");
}

}  // namespace

std::vector<Measurement> drawnRays(const std::shared_ptr<KnownRays>& known, int, const std::vector<int>&) {
  const Row row{.kind = "marching",
                .scene = known->scene().name + ", OpenGL",
                .method = "OpenGL",
                .setting = "the viewer's frames"};
  return {{row, [](Row*) -> double { refuse(); }}};
}

struct ShaderReading::State {};
ShaderReading::ShaderReading(const Expr&, const std::vector<glm::vec4>&, int) { refuse(); }
ShaderReading::~ShaderReading() = default;
void ShaderReading::run() const { refuse(); }
std::vector<float> ShaderReading::values() const { refuse(); }
std::string ShaderReading::driver() { refuse(); }

}  // namespace sdf::chart
