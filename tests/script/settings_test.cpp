// Cameras, lights, materials and colours: each setting arrives in the Scene.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "script/run.h"
#include "sdf/eval/glsl.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "support/settings.h"

namespace sdf {
namespace settings_test {

Scene withSphere(const std::string& text) { return sceneOf(text + "\nreturn sphere(1)"); }

void expectVector(const Vec3E& v, double x, double y, double z) {
  EXPECT_TRUE(v == Vec3E(glm::dvec3(x, y, z)))
      << uniformValue(v.x) << " " << uniformValue(v.y) << " " << uniformValue(v.z);
}

double attribute(const Scene& scene, Attribute a, double x = 0, double y = 0, double z = 0) {
  return at(scene.parts.at(0).shape.surface[static_cast<int>(a)], x, y, z);
}

TEST(Settings, CameraArrives) {
  const Camera c =
      withSphere("camera{from = {1, 2, 3}, to = {0, 1, 0}, up = {0, 0, 1}, fov = 30, mirrored = true}")
          .camera;
  expectVector(c.eye(), 1, 2, 3);
  expectVector(c.to, 0, 1, 0);
  expectVector(c.up, 0, 0, 1);
  EXPECT_TRUE(c.fov.isConstant(30.0));
  EXPECT_TRUE(c.mirrored);
}

TEST(Settings, ACameraMayMoveWithTime) {
  const Scene scene = withSphere("camera{from = {6 * sin(time), 3, 6 * cos(time)}}");
  EXPECT_TRUE(scene.camera.eye().x == 6.0 * sin(Expr::parameter(scene.parameters.at(0))));
}

TEST(Settings, ACameraMayHaveALens) {
  const Camera pinhole = withSphere("camera{from = {1, 2, 3}}").camera;
  EXPECT_TRUE(pinhole.aperture.isConstant(0.0));
  EXPECT_FALSE(pinhole.focus);
  const Camera lens = withSphere("camera{aperture = 0.05, focus = 1 + time}").camera;
  EXPECT_TRUE(lens.aperture.isConstant(0.05));
  ASSERT_TRUE(lens.focus);
  EXPECT_FALSE(lens.focus->isConstant());
}

TEST(Settings, LightsArriveInOrder) {
  const Scene scene = withSphere(
      "directional_light{direction = {1, 2, 3}, color = {1, 0, 0}, intensity = 2, shadow = false}"
      "point_light{position = {4, 5, 6}, radius = 0.5} directional_light{radius = 2 * time}");
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].kind, Light::Kind::Directional);
  expectVector(scene.lights[0].vector, 1, 2, 3);
  expectVector(scene.lights[0].color, 1, 0, 0);
  EXPECT_TRUE(scene.lights[0].intensity.isConstant(2.0));
  EXPECT_FALSE(scene.lights[0].castsShadow);
  EXPECT_EQ(scene.lights[1].kind, Light::Kind::Point);
  expectVector(scene.lights[1].vector, 4, 5, 6);
  EXPECT_TRUE(scene.lights[2].castsShadow);
  EXPECT_TRUE(scene.lights[0].radius.isConstant(0.0));
  EXPECT_TRUE(scene.lights[1].radius.isConstant(0.5));
  EXPECT_FALSE(scene.lights[2].radius.isConstant());
}

TEST(Settings, LightsAreTheStandardOnesWhereNothingIsSaidOfLight) {
  const auto toScene = [](const std::string& text) { return withSphere(text).lights.size(); };
  EXPECT_EQ(toScene(""), standardLights().size());
  EXPECT_EQ(toScene("ambient(0.5)"), 0u);
  EXPECT_EQ(toScene("point_light()"), 1u);
  EXPECT_TRUE(withSphere("").background == standardBackground());
  EXPECT_TRUE(withSphere("background(0.5)").background == Vec3E(Expr(0.5)));
  EXPECT_TRUE(withSphere("ambient(0.5)").background == Scene().background);
}

TEST(Settings, TheStandardLightsCastASoftShadowUnlessTheSceneSaysWhich) {
  const auto kind = [](const std::string& text) { return withSphere(text).shadow.kind; };
  EXPECT_EQ(kind(""), Shadow::Kind::Soft);
  EXPECT_EQ(kind("shadows{kind = 'none'}"), Shadow::Kind::None);
  EXPECT_EQ(kind("shadows{kind = 'hard'}"), Shadow::Kind::Hard);
  EXPECT_EQ(kind("point_light()"), Shadow::Kind::None);
  EXPECT_EQ(kind("ambient(0.5)"), Shadow::Kind::None);
}

TEST(Settings, StandardLightsTellTheSidesOfABoxApart) {
  double side[3] = {};  // towards x, y and z
  for (const Light& light : standardLights()) {
    const glm::dvec3 towards(uniformValue(light.vector.x), uniformValue(light.vector.y),
                             uniformValue(light.vector.z));
    for (int i = 0; i < 3; ++i)
      side[i] += std::max(glm::normalize(towards)[i], 0.0) * uniformValue(light.intensity);
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(side[i], 1.0);
    EXPECT_GT(std::abs(side[i] - side[(i + 1) % 3]), 0.15);
  }
}

TEST(Settings, TheRestArrives) {
  const Scene scene = withSphere(R"(
    ambient{0.1, 0.2, 0.3}
    fog{color = 0.5, density = 0.25}
    shadows{kind = "improved", sharpness = 16, start = 0.1, reach = 5, steps = 7}
    ambient_occlusion{kind = "steps", spacing = 0.5, count = 3, strength = 0.005}
    reflections{bounces = 2, glossy = true}
    max_distance(40)
    tone("filmic")
    gamma(2.2)
    bounds({-1, -2, -3}, {1, 2, 3}))");
  expectVector(scene.ambient, 0.1, 0.2, 0.3);
  expectVector(scene.fog.color, 0.5, 0.5, 0.5);
  EXPECT_TRUE(scene.fog.density.isConstant(0.25));
  EXPECT_EQ(scene.shadow.kind, Shadow::Kind::Improved);
  EXPECT_TRUE(scene.shadow.sharpness.isConstant(16.0));
  EXPECT_EQ(scene.shadow.start, 0.1);
  EXPECT_EQ(scene.shadow.reach, 5.0);
  EXPECT_EQ(scene.shadow.steps, 7);
  EXPECT_EQ(scene.ambientOcclusion.kind, AmbientOcclusion::Kind::Steps);
  EXPECT_EQ(scene.ambientOcclusion.spacing, 0.5);
  EXPECT_EQ(scene.ambientOcclusion.count, 3);
  EXPECT_TRUE(scene.ambientOcclusion.strength.isConstant(0.005));
  EXPECT_EQ(scene.reflectionBounces, 2);
  EXPECT_TRUE(scene.glossyReflections);
  EXPECT_EQ(scene.maxDistance, 40.0);
  EXPECT_EQ(scene.tone, Tone::Filmic);
  EXPECT_EQ(scene.gamma, 2.2);
  ASSERT_TRUE(scene.bounds);
  EXPECT_EQ(scene.bounds->min, glm::dvec3(-1, -2, -3));
  EXPECT_EQ(scene.bounds->max, glm::dvec3(1, 2, 3));
}

TEST(Settings, TheBackgroundsLightTakesThePlaceOfAmbientLight) {
  const Scene alone = withSphere("background_light(0.5)");
  EXPECT_TRUE(alone.backgroundLight.isConstant(0.5));
  expectVector(alone.ambient, 0, 0, 0);
  EXPECT_TRUE(alone.lights.empty());
  EXPECT_EQ(alone.shadow.kind, Shadow::Kind::None);
  for (const char* both : {"background_light(0.5) ambient(0.3)", "ambient(0.3) background_light(0.5)"})
    expectVector(withSphere(both).ambient, 0.3, 0.3, 0.3);
}

TEST(Settings, WithoutSettingsTheScenesDefaultsStand) {
  const Scene scene = withSphere(""), fresh;
  EXPECT_FALSE(scene.camera.from);
  EXPECT_TRUE(scene.ambient == fresh.ambient);
  EXPECT_EQ(scene.shadow.kind, standardShadow().kind);
  EXPECT_FALSE(scene.bounds);
  EXPECT_FALSE(scene.gamma);
}

// The defaults that the reference gives, written out, change nothing.
// They stay inputs, but the scene is made for their present values.
TEST(Settings, NarrowedParametersHaveTheirPresentValueAlone) {
  const std::string text = R"(
local b, r = param("b", 10, {min = 0, max = 40}), param("r", 1, {min = 0.5, max = 2})
return box(1, 0.2, 0.5):bend(b + 5 * sin(time)), sphere(r))";
  const auto slope = [](const Scene& scene) { return scene.parts.front().shape.claim.lipschitz; };
  const auto reach = [](const Scene& scene) { return scene.parts.back().shape.bounds.max.x; };
  const ScriptOptions now{.values = {{"b", 12.0}}, .time = 0.5};
  ScriptOptions fixed = now, narrowed = now;
  fixed.fixed = true;
  narrowed.narrowed = {"b", "time"};
  const Scene wide = sceneOf(text, now), number = sceneOf(text, fixed), known = sceneOf(text, narrowed);
  EXPECT_GT(wide.parts.front().shape.bounds.max.x, 1.1 * number.parts.front().shape.bounds.max.x);
  EXPECT_NEAR(slope(known), slope(number), 1e-9 * slope(number));
  EXPECT_EQ(known.parts.front().shape.bounds.max.x, number.parts.front().shape.bounds.max.x);
  EXPECT_EQ(reach(known), 2.0) << "another parameter has its range";
  EXPECT_EQ(known.parameters, wide.parameters) << "as sliders have them";
  const Function distance(known.parts.front().shape.distance);
  EXPECT_NE(std::ranges::find(distance.inputs(), "b", &ParameterInfo::name), distance.inputs().end());
}

TEST(Settings, DefaultsCanBeWrittenOut) {
  int count = 0;
  for (const Setting<Scene>& setting : sceneSettings())
    for (const SettingField<Scene>& field : setting.fields) {
      Scene usual;
      if (setting.begin) setting.begin(usual);
      const std::string text = written(field, field.get(usual));
      if (text == field.unset) continue;
      const Scene scene = withSphere(
          setting.name + (setting.alone ? "(" + text + ")" : "{" + field.name + " = " + text + "}"));
      for (const SettingField<Scene>& other : setting.fields)
        EXPECT_TRUE(same(other.get(scene), other.get(usual)))
            << setting.name << " " << field.name << " " << other.name;
      ++count;
    }
  EXPECT_GE(count, 16);
}

// The names, the ids and the shader's text for them depend on nothing that was loaded before.
TEST(Settings, MaterialsAreNumberedWithinTheirScene) {
  const std::string text =
      "local m = material{color = 0.5} part('a', sphere(1):paint('#f00') | box(1):paint{name = 'clay'})"
      "part('b', (plane() | sphere(2):paint(m)) | (box(2):paint(m) | box(3):paint(0.2)))";
  const auto said = [&] {
    const Scene scene = sceneOf(text);
    std::vector<std::string> said;
    for (const Shape& shape : {scene.parts[0].shape, scene.parts[1].shape, scene.whole()}) {
      for (const MaterialPtr& m : shape.materials) said.push_back(m->name);
      GlslWriter writer;
      writer.add("id", std::vector{shape.surface[static_cast<int>(Attribute::MaterialId)]});
      said.push_back(writer.source());
    }
    return said;
  };
  const std::vector<std::string> alone = said();
  EXPECT_EQ(alone[0], "material 2");
  EXPECT_EQ(alone[1], "clay");
  EXPECT_EQ(alone[3], "default");
  EXPECT_EQ(alone[4], "material 1");
  EXPECT_EQ(alone[5], "material 4");
  const Scene between = sceneOf("for i = 1, 9 do part('ball ' .. i, sphere(i):paint(0.5)) end");
  EXPECT_EQ(between.parts[8].shape.materials[0]->name, "material 9");
  EXPECT_EQ(said(), alone);
}

TEST(Settings, MaterialsOfTwoScenesStayApart) {
  const Scene a = sceneOf("return sphere(1):paint('#f00')"), b = sceneOf("return box(1):paint('#00f')");
  const Shape both = unite(a.parts[0].shape, translate(b.parts[0].shape, {4.0, 0.0, 0.0}));
  ASSERT_EQ(both.materials.size(), 2u);
  const Expr& id = both.surface[static_cast<int>(Attribute::MaterialId)];
  EXPECT_EQ(both.materials[std::size_t(at(id, 0, 0, 0))], a.parts[0].shape.materials[0]);
  EXPECT_EQ(both.materials[std::size_t(at(id, 4, 0, 0))], b.parts[0].shape.materials[0]);
}

TEST(Settings, EveryFieldOfAMaterialReachesTheSurface) {
  const Scene scene = sceneOf(R"(return sphere(1):paint{name = "clay", color = {0.1, 0.2, 0.3}, ambient = 0.4,
    specular = {0.5, 0.6, 0.7}, shininess = 64, reflectivity = 0.8, fresnel_power = 5, fresnel_bias = 0.04,
    emission = {0, 0, 1}})");
  const Material& m = *scene.parts.at(0).shape.materials.at(0);
  EXPECT_EQ(m.name, "clay");
  EXPECT_EQ(attribute(scene, Attribute::Red), 0.1);
  EXPECT_EQ(attribute(scene, Attribute::Green), 0.2);
  EXPECT_EQ(attribute(scene, Attribute::Blue), 0.3);
  EXPECT_EQ(attribute(scene, Attribute::AmbientRed), 0.4);
  EXPECT_EQ(attribute(scene, Attribute::SpecularGreen), 0.6);
  EXPECT_EQ(attribute(scene, Attribute::Shininess), 64);
  EXPECT_EQ(attribute(scene, Attribute::Reflectivity), 0.8);
  EXPECT_EQ(attribute(scene, Attribute::FresnelPower), 5);
  EXPECT_EQ(attribute(scene, Attribute::FresnelBias), 0.04);
  EXPECT_EQ(attribute(scene, Attribute::EmissionBlue), 1);
}

TEST(Settings, OneMaterialOnTwoShapesStaysOne) {
  const Scene scene = sceneOf("local m = material{color = 0.5} return sphere(1):paint(m), box(1):paint(m)");
  EXPECT_EQ(scene.parts.at(0).shape.materials.at(0), scene.parts.at(1).shape.materials.at(0));
}

TEST(Colors, TextIsSrgbAndBecomesLinear) {
  // IEC 61966-2-1 at 0x80: ((128/255 + 0.055) / 1.055)^2.4.
  const double half = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
  expectVector(withSphere("ambient('#ff8000')").ambient, 1, half, 0);
  EXPECT_TRUE(withSphere("ambient('#f00')").ambient == withSphere("ambient('#ff0000')").ambient);
  EXPECT_TRUE(withSphere("ambient('#ABCDEF')").ambient == withSphere("ambient('#abcdef')").ambient);
}

TEST(Colors, EveryFormOfAColorMeansTheSame) {
  for (const char* form :
       {"{0.5, 0.5, 0.5}", "0.5", "color(0.5, 0.5, 0.5)", "color(0.5)", "function() return 0.5, 0.5, 0.5 end",
        "function() return {0.5, 0.5, 0.5} end", "function() return 0.5 end"})
    EXPECT_EQ(
        attribute(sceneOf("return sphere(1):paint{color = " + std::string(form) + "}"), Attribute::Green),
        0.5)
        << form;
  for (const char* form : {"'#fff'", "{1, 1, 1}", "1", "function() return 1 end"})
    EXPECT_EQ(attribute(sceneOf("return sphere(1):paint(" + std::string(form) + ")"), Attribute::Green), 1.0)
        << form;
}

TEST(Colors, FunctionsSeePositionAndNormal) {
  const Scene scene = sceneOf(
      "return sphere(1):paint{color = function(x, y, z, nx, ny, nz) return x, y * z, ny end,"
      "reflectivity = function(x) return x * x end}");
  EXPECT_EQ(attribute(scene, Attribute::Red, 0.25, 2, 3), 0.25);
  EXPECT_EQ(attribute(scene, Attribute::Green, 0.25, 2, 3), 6);
  EXPECT_EQ(attribute(scene, Attribute::Reflectivity, 3), 9);
  EXPECT_TRUE(scene.parts[0].shape.surface[static_cast<int>(Attribute::Blue)] == normal().y);
}

TEST(Colors, PatternsMoveWithTheirShape) {
  const Scene scene = sceneOf("return sphere(1):paint{color = function(x) return x end}:translate(10, 0, 0)");
  EXPECT_EQ(attribute(scene, Attribute::Red, 10.5), 0.5);
}

TEST(Patterns, ACheckerboardAlternatesInXAndZ) {
  const Scene scene = sceneOf("return plane():paint(checkerboard(0.25, 0.75, {scale = 2}))");
  for (const auto& [x, z, grey] : {std::array{1.0, 1.0, 0.25},
                                   {3.0, 1.0, 0.75},
                                   {1.0, 3.0, 0.75},
                                   {3.0, 3.0, 0.25},
                                   {-1.0, 1.0, 0.75},
                                   {-1.0, -1.0, 0.25}})
    EXPECT_EQ(attribute(scene, Attribute::Red, x, 5.0, z), grey) << x << " " << z;
}

TEST(Patterns, AGradientGoesFromOneColorToTheOther) {
  const Scene scene = sceneOf("return sphere(1):paint(gradient('y', 0, 1, {from = 2, to = 4}))");
  for (const auto& [y, grey] : {std::pair{1.0, 0.0}, {2.0, 0.0}, {3.0, 0.5}, {4.0, 1.0}, {9.0, 1.0}})
    EXPECT_EQ(attribute(scene, Attribute::Red, 7, y, 7), grey) << y;
  const Scene slanted = sceneOf("return sphere(1):paint(gradient({1, 1, 0}, 0, 1))");
  EXPECT_EQ(attribute(slanted, Attribute::Red, 0.25, 0.25, 9), 0.5);
}

TEST(Patterns, BackgroundsDependOnTheRaysDirection) {
  const Scene scene = withSphere("background(vertical_gradient(0, 1))");
  EXPECT_EQ(at(scene.background.x, 0, -1, 0), 0.0);
  EXPECT_EQ(at(scene.background.x, 1, 0, 0), 0.5);
  EXPECT_EQ(at(scene.background.x, 0, 1, 0), 1.0);
  const Scene sun = withSphere(
      "background(sky{horizon = 0, zenith = 0.5, ground = 0.25, sun = {0, 2, 0}, sun_color = {1, 0, 0}})");
  EXPECT_EQ(at(sun.background.x, 0, 1, 0), 1.5);
  EXPECT_EQ(at(sun.background.y, 0, 1, 0), 0.5);
  EXPECT_EQ(at(sun.background.y, 0, -1, 0), 0.25);
  const Scene free = withSphere("background(function(x, y, z) return x, y, z end)");
  EXPECT_EQ(at(free.background.z, 1, 2, 3), 3.0);
}

// A pattern that takes the fraction of a large number differs between float and double; this one may not, by
// more than its slope times the rounding of its coordinates.
TEST(Patterns, NoiseStaysInRangeAndVariesGently) {
  const Scene scene = sceneOf(
      "return sphere(1):paint{reflectivity = function(x, y, z) "
      "return 0.5 + 0.5 * noise(x, y, z, {octaves = 4}) end}");
  const Expr& noise = scene.parts.at(0).shape.surface[static_cast<int>(Attribute::Reflectivity)];
  ASSERT_TRUE(std::isfinite(noise.lipschitz()));
  double least = 1.0, most = 0.0;
  constexpr double kStep = 0.37, kNudge = 1e-6;
  constexpr double kRounding =
      256 * std::numeric_limits<double>::epsilon();  // some 60 operations on numbers below 64
  for (double x = -20.0; x < 20.0; x += kStep)
    for (double y = -3.0; y < 3.0; y += kStep) {
      const double v = at(noise, x, y, x * y);
      least = std::min(least, v);
      most = std::max(most, v);
      EXPECT_LE(std::abs(at(noise, x + kNudge, y, x * y) - v), noise.lipschitz() * kNudge + kRounding);
    }
  EXPECT_GE(least, 0.0);
  EXPECT_LE(most, 1.0);
  EXPECT_LT(least, 0.25) << "it uses its range";
  EXPECT_GT(most, 0.75) << "it uses its range";
}

TEST(Patterns, MixBlendsColors) {
  expectVector(withSphere("ambient(mix('#fff', {0, 0.5, 1}, 0.5))").ambient, 0.5, 0.75, 1);
}

}  // namespace settings_test
}  // namespace sdf
