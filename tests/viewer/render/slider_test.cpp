// Scenes whose shapes hang on sliders and on the clock, held to the same scenes with numbers in their places.
#include <cstdlib>
#include <random>

#include "support/folder.h"
#include "viewer/headless_test.h"
#include "viewer/render/present_scene.h"
#include "viewer/render/psnr.h"
#include "viewer/render/renderer.h"
#include "viewer/shaders/compile_count.h"

namespace sdf::viewer {
namespace slider_test {

using test::CompileCount;

// Values of the inputs that scenes here have, as sliders or as numbers.
struct Inputs {
  double a, b, time;
  Values parameters() const { return {{"a", a}, {"b", b}}; }
};

std::string textOf(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", v);
  return text;
}

constexpr const char* kSliders =
    "local a, b, t = param('a', 0.5, {min = 0, max = 1}), param('b', 0.5, {min = 0, max = 1}), time\n";
std::string numbersOf(const Inputs& in) {
  return "local a, b, t = " + textOf(in.a) + ", " + textOf(in.b) + ", " + textOf(in.time) + "\n";
}

constexpr const char* kView = R"(camera{from = {2.2, 1.8, 3.2}, to = {0, 0, 0}, fov = 40}
directional_light{direction = {-1, 1.5, 2}} shadows{} ambient(0.2) ambient_occlusion{}
)";

struct Drawn {
  std::vector<glm::dvec3> colors;
  std::size_t outOfSteps = 0;
  double readings = 0.0;  // a pixel, of all kinds
};

Drawn draw(Renderer& renderer, const Scene& scene, const Inputs& in) {
  constexpr int kWidth = 96, kHeight = 64;
  Values values = in.parameters();
  values["time"] = in.time;
  Frame frame = frameOf(LookFunction(scene), values, static_cast<double>(kWidth) / kHeight);
  frame.samples = 2;
  const auto target = Target::create(kWidth, kHeight, {PixelFormat::Rgba8, PixelFormat::Rgba32f});
  if (!target || !renderer.draw(frame, *target)) throw std::runtime_error("cannot draw");
  const auto picture = target->picture();
  const auto readings = renderer.readings(*target);
  if (!picture || !readings) throw std::runtime_error("cannot read what was drawn");
  Drawn drawn{{}, pixelsOutOfSteps(*picture), readings->primary + readings->shadow + readings->occlusion};
  for (std::size_t i = 0; i < picture->bytes.size(); i += 4) {
    const unsigned char* const p = &picture->bytes[i];
    drawn.colors.push_back(glm::dvec3(p[0], p[1], p[2]) / 255.0);
  }
  return drawn;
}

ShaderOptions by(ShaderOptions options, Steps steps) {
  options.steps = steps;
  return options;
}

/// A scene of a file in the viewer: loaded once, and moved from values to values.
class Moving {
 public:
  Moving(const SceneFile& file, const Inputs& in, ShaderOptions options)
      : all_(file.load({.values = in.parameters(), .time = in.time})),
        present_(file, all_.value(), in.parameters(), in.time),
        renderer_(Renderer::make(present_.at(*all_, in.parameters(), in.time), by(options, present_.steps()),
                                 present_.other())) {
    if (!renderer_) throw std::runtime_error(renderer_.error().message);
  }

  const std::set<std::string>& inputs() const { return present_.inputs(); }
  Steps steps() const { return present_.steps(); }
  Drawn drawn(const Inputs& in) {
    if (present_.move(in.parameters(), in.time))
      if (const auto s = renderer_->follow(present_.at(*all_, in.parameters(), in.time)); !s)
        throw std::runtime_error(s.error().message);
    return draw(*renderer_, *all_, in);
  }

 private:
  Result<Scene> all_;
  PresentScene present_;
  Result<Renderer> renderer_;
};

class SliderTest : public HeadlessTest {
 protected:
  SceneFile file(const std::string& text) {
    const auto path = folder / ("scene" + std::to_string(++files) + ".lua");
    std::ofstream(path) << kView << text;
    return {path};
  }

  /// The scene with numbers; nothing where it is refused.
  std::optional<Drawn> byNumbers(const std::string& shape, const Inputs& in, ShaderOptions options = {}) {
    options.countReadings = true;
    const auto scene = file(numbersOf(in) + shape).load({});
    if (!scene) return {};
    auto renderer = Renderer::make(*scene, options);
    return renderer ? std::optional(draw(*renderer, *scene, in)) : std::nullopt;
  }

  Moving bySliders(const std::string& shape, const Inputs& in, ShaderOptions options = {}) {
    options.countReadings = true;
    return {file(kSliders + shape), in, options};
  }

  std::set<std::string> inputsOf(const std::string& text, const ScriptOptions& options = {}) {
    const SceneFile scene = file(text);
    const auto loaded = scene.load(options);
    if (!loaded) throw std::runtime_error(loaded.error().message);
    return PresentScene(scene, *loaded, options.values, options.time).inputs();
  }

  std::size_t outOfStepsMoved(Moving& moving, const std::string& shape, const Inputs& to);

  const Folder folder;
  int files = 0;
};

// Both read the same distances, but for rounding, with which a ray beside an edge may hit or not: such a
// sample in a picture of these sizes leaves 50 dB.
void expectAlike(const Drawn& drawn, const Drawn& right) {
  constexpr double kDecibels = 50.0, kMoreReadings = 1.3;
  EXPECT_GE(test::psnr(drawn.colors, right.colors), kDecibels);
  EXPECT_LE(drawn.readings, kMoreReadings * right.readings);
  EXPECT_LE(drawn.outOfSteps, right.outOfSteps);
}

constexpr Inputs kFrom{0.4, 0.7, 0.3};

// Expects what was drawn before to look at other values as with numbers, and to compile nothing for it.
// Returns the pixels out of steps.
std::size_t SliderTest::outOfStepsMoved(Moving& moving, const std::string& shape, const Inputs& to) {
  const auto right = byNumbers(shape, to);
  EXPECT_TRUE(right);
  if (!right) return 0;
  const CompileCount compiled;
  const Drawn drawn = moving.drawn(to);
  EXPECT_EQ(compiled.value(), 0);
  expectAlike(drawn, *right);
  return drawn.outOfSteps;
}

// As they were reported: the slope of the whole range is 50 times that of the present values.
constexpr const char* kSteep[] = {
    "part('logo', (box(1, 0.2, 0.5) | cylinder(0.2, 0.5):translate(0.3, 0.5, 0)):bend(40 * a))",
    "part('logo', (box(0.3, 0.7, 0.2) | box(1.9, 1, 0.06):translate(0, 0, -0.28)):rotate(90, 0, 0):bend(40 * "
    "a))",
    "part('logo', (box(0.5, 0.8, 0.3) | cylinder(0.2, 0.7):translate(0.3, 0.2, 0)):taper(0.5 * sin(t)))",
    "part('logo', (box(0.5, 0.8, 0.3) | cylinder(0.2, 0.7):translate(0.3, 0.2, 0)):twist(30 * t))"};

TEST_F(SliderTest, SteepensNoMoreThanItsValueAndCompilesNothing) {
  constexpr Inputs kTo[] = {{0.1, 0.0, 1.0}, {0.35, 0.0, 2.5}};
  for (const char* const shape : kSteep) {
    SCOPED_TRACE(shape);
    Moving moving = bySliders(shape, kFrom);
    moving.drawn(kFrom);
    for (const Inputs& to : kTo) EXPECT_EQ(outOfStepsMoved(moving, shape, to), 0u);
  }
}

std::string fieldOf(const std::string& formula) {
  return "part('f', field(function(x, y, z) local k = 0.5 + a; " + formula +
         " end, {bounds = {{-1.6, -1.6, -1.3}, {1.6, 1.6, 1.6}}}))\n";
}

const std::string kHeart = "local q = x*x + 2.25*z*z + y*y - 1 return q*q*q - k*x*x*y*y*y - 0.1125*z*z*y*y*y";

TEST_F(SliderTest, SteepFormulasAreReadAsOftenAsWithNumbers) {
  const std::string formulas[] = {
      kHeart,
      "return k*x^4 + y^4 + z^4 - 1",
      "return x^4 + y^4 + z^4 - 1.5*k*(x*x + y*y + z*z) + 0.9",
      "return k*(exp(2*x) + exp(-2*x) + exp(2*y) + exp(-2*y) + exp(2*z) + exp(-2*z)) - 8",
      "local q = x*x + y*y + z*z + k - 0.1 return q*q - 4*k*(x*x + y*y)",
      "return k*x^3 + y^3 + z^3 + 0.5 - x*y*z"};
  std::vector<std::string> scenes;
  for (const std::string& formula : formulas) scenes.push_back(fieldOf(formula));
  std::string scaled = fieldOf(kHeart);  // the slider is the scale's alone
  scaled.replace(scaled.find("0.5 + a"), 7, "1").insert(scaled.rfind(')'), ":scale(0.5 + a)");
  scenes.push_back(scaled);
  scenes.push_back(scenes[0] + "part('g', box(0.4):translate(1, 1, 1):bend(20 * b))\n" + "part('f2'" +
                   scenes[1].substr(8));
  constexpr Inputs kTo[] = {{0.1, 0.6, 1.0}, {0.9, 0.2, 0.3}};
  for (const std::string& scene : scenes) {
    SCOPED_TRACE(scene);
    Moving moving = bySliders(scene, kFrom);
    EXPECT_TRUE(moving.inputs().contains("a"));
    moving.drawn(kFrom);
    for (const Inputs& to : kTo) outOfStepsMoved(moving, scene, to);
  }
}

TEST_F(SliderTest, TheClockMakesTablesWhereTheySaveMoreThanTheyCost) {
  std::string heart = fieldOf(kHeart), cubic = fieldOf("return k*x^3 + y^3 + z^3 + 0.5 - x*y*z");
  for (std::string* const scene : {&heart, &cubic})
    scene->replace(scene->find("0.5 + a"), 7, "1 + 0.5*sin(t)");
  Moving moving = bySliders(heart, kFrom);
  EXPECT_EQ(moving.inputs(), std::set<std::string>{"time"});
  moving.drawn(kFrom);
  constexpr Inputs kTo{0.0, 0.0, 1.4};
  const Drawn drawn = moving.drawn(kTo);
  expectAlike(drawn, *byNumbers(heart, kTo));
  Moving slow = bySliders(cubic, kFrom);
  slow.drawn(kFrom);
  const auto right = byNumbers(cubic, kTo, by({}, Steps::BySlope));
  const CompileCount compiled;
  expectAlike(slow.drawn(kTo), *right);
  EXPECT_EQ(compiled.value(), 0);
}

TEST_F(SliderTest, SeesItsValueHoweverRaysStartAndIsDrawn) {
  constexpr Inputs kTo{0.3, 0.25, 0.8};
  const std::string bent = "part('bent', (box(1, 0.2, 0.5) - sphere(0.3)):bend(40 * a):twist(20 * t))\n";
  const std::string floor = "part('floor', plane({0, 1, 0}, -0.6))\n";
  std::ofstream(folder / "corner.obj")
      << "v 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 0\nf 1 2 3\nf 2 1 4\nf 3 2 4\nf 1 3 4\n";
  // Kinds that are read by lists, and drawn group by group; and beside a mesh that is drawn as triangles.
  const std::string many =
      "for i = 0, 24 do part('p' .. i, box(0.15, 0.05, 0.1):bend(120 * a + i):translate(i % 5 * 0.5 - 1, "
      "0, i // 5 * 0.5 - 1)) end\n";
  const std::string mesh = "part('mesh', mesh('corner.obj', {voxels = 16}):rotate(0, 90 * b, 0))\n";
  const struct {
    std::string text;
    ShaderOptions options;
  } cases[] = {{bent, {.start = Start::Raster}},
               {bent + floor, {.start = Start::Plain}},
               {bent, {.view = View::Steps}},
               {bent + floor, {.method = Method::Plain}},
               {many, {}},
               {many + floor, {.culling = false}},
               {bent + mesh, {}}};
  for (const auto& [text, options] : cases) {
    SCOPED_TRACE(text);
    Moving moving = bySliders(text, kFrom, options);
    EXPECT_TRUE(moving.inputs().contains("a"));
    const auto right = byNumbers(text, kTo, options);
    ASSERT_TRUE(right);
    expectAlike(moving.drawn(kTo), *right);
  }
}

TEST_F(SliderTest, FindsTheInputsThatSlopesHangOn) {
  const std::string header(kSliders);
  using Names = std::set<std::string>;
  const struct {
    const char* shape;
    Names inputs;
  } cases[] = {
      {"box(1, 0.2, 0.5):bend(40 * a)", {"a"}},
      {"box(1, 0.2, 0.5):bend(40 * a):translate(b, sin(t), 0)", {"a", "b", "time"}},  // its bounds, too
      {"box(1, 0.2, 0.5):bend(40 * a) | sphere(0.2):translate(b, sin(t), 0)", {"a"}},
      {"box(1, 0.2, 0.5):bend(20 * a + 20 * b)", {"a", "b"}},
      {"box(0.2, 1, 0.5):twist(30 * t)", {"time"}},
      {"sphere(0.2 + a):translate(b, sin(t), 0) | box(a + 0.1)", {}},
      {"union({sphere(0.2 + a), box(0.5)}, {k = 0.1 + b})", {}},
      {"box(1, 0.2, 0.5):bend(20):paint{color = {a, b, t}}", {}},
      {"field(function(x, y, z) return x*x + y*y*a + z*z - 0.5 end, {bounds = {{-1, -1, -1}, {1, 1, 1}}})",
       {"a"}}};
  for (const auto& [shape, inputs] : cases) {
    EXPECT_EQ(inputsOf(header + "part('s', " + shape + ")"), inputs) << shape;
    const Values ends{{"a", 1.0}, {"b", 1.0}};
    EXPECT_EQ(inputsOf(header + "part('s', " + shape + ")", {.values = ends}), inputs)
        << shape << ": the ends of the ranges tell no less";
  }
  EXPECT_EQ(inputsOf(header + "part('s', box(1, 0.2, 0.5):bend(40 * value(a)))"), Names())
      << "the script is run again for its values anyway";
}

// The file allows no shell of no thickness, but sliders have one that is hardly there.
TEST_F(SliderTest, KeepsTheSlopesOfAllValuesWhereTheFileAllowsNoOthers) {
  const char* const shape = "part('s', box(0.5):twist(90 * b):shell(0.1 * a))";
  Moving moving = bySliders(shape, kFrom);
  EXPECT_TRUE(moving.inputs().contains("a"));
  const Inputs none{0.0, 0.5, 0.0}, again{0.8, 0.2, 0.0};
  EXPECT_FALSE(byNumbers(shape, none));
  EXPECT_EQ(moving.drawn(none).outOfSteps, 0u);
  expectAlike(moving.drawn(again), *byNumbers(shape, again));
}

// Where the number of copies that are looked at follows from the value, so does the code.
TEST_F(SliderTest, CompilesWhereTheCodeIsAnother) {
  const char* const shape =
      "part('s', box(0.4, 0.2, 0.2):bend(30 * b):repeat_grid({0.5 + 1.2 * a, 0, 0}, {5, 1, 1}))";
  Moving moving = bySliders(shape, {0.9, 0.5, 0.0});
  const CompileCount compiled;
  const Inputs to{0.05, 0.6, 0.0};
  expectAlike(moving.drawn(to), *byNumbers(shape, to));
  EXPECT_GT(compiled.value(), 0);
}

/// Shapes made of random operators with random formulas of inputs.
class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  std::string shape(int operators) {
    std::string text = base();
    for (int i = 0; i < operators; ++i) text = "(" + text + ")" + changed();
    return text;
  }

 private:
  int choose(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

  // A formula of an input, or a number, in this range.
  std::string in(double lo, double hi) {
    const char* const inputs[] = {"a", "b", "(0.5 + 0.5 * sin(t))"};
    const double share = random_() / 4294967296.0;
    if (choose(3) == 0) return textOf(lo + (hi - lo) * share);
    return "(" + textOf(lo) + " + " + textOf(hi - lo) + " * " + inputs[choose(3)] + ")";
  }

  std::string solid() {
    switch (choose(6)) {
      case 0:
        return "box(" + in(0.3, 0.7) + ", " + in(0.2, 0.5) + ", " + in(0.2, 0.5) + ")";
      case 1:
        return "cylinder(" + in(0.2, 0.4) + ", " + in(0.4, 0.7) + ")";
      case 2:
        return "torus(" + in(0.4, 0.6) + ", " + in(0.1, 0.2) + ")";
      case 3:
        return "capsule({-0.5, 0, 0}, {0.5, " + in(0, 0.4) + ", 0}, " + in(0.15, 0.3) + ")";
      case 4:
        return "field(function(x, y, z) return x*x + " + in(1, 3) + "*y*y + z*z - " + in(0.15, 0.3) +
               " end, {bounds = {{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}}})";
      default:
        return "sphere(" + in(0.3, 0.6) + ")";
    }
  }

  std::string base() {
    const std::string one = solid();
    const std::string other = solid() + ":translate(" + in(0.1, 0.4) + ", 0.2, " + in(-0.2, 0.2) + ")";
    switch (choose(6)) {
      case 0:
        return one + " | " + other;
      case 1:
        return "union({" + one + ", " + other + "}, {k = " + in(0.05, 0.3) + "})";
      case 2:
        return one + " - " + other;
      case 3:
        return "morph(" + one + ", " + other + ", " + in(0, 1) + ")";
      default:
        return one;
    }
  }

  std::string changed() {
    switch (choose(11)) {
      case 0:
        return ":bend(" + in(-40, 40) + ")";
      case 1:
        return ":twist(" + in(-90, 90) + ")";
      case 2:
        return ":taper(" + in(-0.5, 0.5) + ")";
      case 3:
        return ":round(" + in(0, 0.15) + ")";
      case 4:
        return ":shell(" + in(0.02, 0.1) + ")";
      case 5:
        return ":scale(" + in(0.6, 1.2) + ")";
      case 6:
        return ":displace(" + in(0, 0.06) + ", " + in(2, 8) + ")";
      case 7:
        return ":elongate{" + in(0, 0.2) + ", " + in(0, 0.2) + ", 0}";
      case 8:
        return ":rotate(" + in(0, 60) + ", " + in(0, 60) + ", 0)";
      case 9:
        return ":repeat_grid({" + in(1.2, 1.6) + ", 0, 0}, {2, 1, 1})";
      default:
        return ":twist(" + in(-120, 120) + "):round(" + in(0.01, 0.1) + ")";
    }
  }

  std::mt19937 random_;
};

// What is refused for its whole range, such as a bend that would fold, or with numbers, is no matter here.
TEST_F(SliderTest, RandomShapesAreThoseByNumbers) {
  const Inputs to{0.83, 0.21, 1.9};
  const char* const asked = std::getenv("SDF_SLIDER_SEEDS");
  const int count = asked ? std::atoi(asked) : 24;
  int drawn = 0;
  for (int seed = 0; seed < count; ++seed) {
    Generator generator(static_cast<unsigned>(seed));
    const std::string shape = "part('shape', " + generator.shape(1 + seed % 3) + ")\n";
    SCOPED_TRACE(std::to_string(seed) + ": " + shape);
    if (!file(kSliders + shape).load({})) continue;
    Moving moving = bySliders(shape, kFrom);
    const bool hasClock = shape.find("sin(t)") != std::string::npos;  // gentle shapes have no tables then
    const auto right = byNumbers(
        shape, to,
        by({}, hasClock && moving.steps() != Steps::ByRegionNow ? Steps::BySlope : Steps::ByRegion));
    if (!right) continue;
    expectAlike(moving.drawn(to), *right);
    ++drawn;
  }
  EXPECT_GE(drawn, count * 4 / 5);
}

}  // namespace slider_test
}  // namespace sdf::viewer
