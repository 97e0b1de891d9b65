#include "shader_reading.h"

#include "opengl.h"
#include "sdf/eval/glsl.h"
#include "sdfchart/measure/measure.h"
#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/gpu/texels.h"
#include "viewer/render/frame.h"

namespace sdf::chart {
namespace {

// A pixel of column i reads the i-th point.
constexpr const char* kMain = R"(
uniform sampler2D points;
layout(location = 0) out vec4 value;
void main() {
  sdfTakeValues();
  value = vec4(read(texelFetch(points, ivec2(int(gl_FragCoord.x), 0), 0).xyz, vec3(0.0, 1.0, 0.0)));
}
)";

viewer::Program compiled(const Expr& distance) {
  openedDriver();
  GlslWriter writer;
  writer.add("read", {&distance, 1});
  viewer::Program program =
      take(viewer::Program::overScreen("#version 330 core\n" + writer.source() + kMain));
  viewer::UniformValues values(writer.uniforms());
  values.move({});
  if (!values.vectors().empty()) program.set("sdfValues", values.vectors());
  program.set("points", 0);
  return program;
}

}  // namespace

struct ShaderReading::State {
  viewer::Program program;
  viewer::Texels points;
  viewer::Target target;
};

ShaderReading::ShaderReading(const Expr& distance, const std::vector<glm::vec4>& points, int times) {
  const int count = static_cast<int>(points.size());
  viewer::Program program = compiled(distance);
  state_.reset(new State{std::move(program), viewer::Texels(count),
                         take(viewer::Target::create(count, times, {viewer::PixelFormat::Rgba32f}))});
  state_->points.fill(points);
  run();
}

ShaderReading::~ShaderReading() = default;

void ShaderReading::run() const {
  openedDriver();
  state_->points.bind(0);
  state_->target.bind();
  state_->program.draw();
  viewer::finish();
  take(viewer::check("read by a shader"));
}

std::vector<float> ShaderReading::values() const {
  const std::vector<glm::vec4> pixels = take(state_->target.pixels());
  std::vector<float> values;
  for (int i = 0; i < state_->target.width(); ++i) values.push_back(pixels[static_cast<std::size_t>(i)].x);
  return values;
}

std::string ShaderReading::driver() { return "OpenGL: " + openedDriver().renderer; }

}  // namespace sdf::chart
