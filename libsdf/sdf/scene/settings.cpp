#include "sdf/scene/settings.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <type_traits>

namespace sdf {

namespace {

using Kind = SettingKind;

template <class T>
SettingValue valueOf(const T& member) {
  if constexpr (std::is_enum_v<T>)
    return static_cast<int>(member);
  else if constexpr (requires { member.has_value(); })
    return member ? SettingValue(*member) : SettingValue();
  else
    return member;
}

template <class T>
void fill(T& member, const SettingValue& value) {
  if constexpr (std::is_enum_v<T>)
    member = static_cast<T>(std::get<int>(value));
  else if constexpr (requires { member.has_value(); })
    member = std::get<typename T::value_type>(value);
  else
    member = std::get<T>(value);
}

template <class Owner, class Member>
Owner ownerOf(Member Owner::*);

// A field that fills the member at the end of a path of pointers to members.
template <auto kFirst, auto... kRest>
auto field(std::string name, Kind kind, std::string doc, Rule rule = Rule::Any, std::string unset = "",
           std::vector<std::string> choices = {}) {
  using Owner = decltype(ownerOf(kFirst));
  SettingField<Owner> f;
  static_cast<SettingInfo&>(f) = {std::move(name), kind, std::move(doc), rule, std::move(choices),
                                  std::move(unset)};
  f.get = [](const Owner& owner) { return valueOf(((owner.*kFirst).*....*kRest)); };
  f.set = [](Owner& owner, const SettingValue& value) { fill(((owner.*kFirst).*....*kRest), value); };
  return f;
}

struct KindWords {
  const char* article;
  const char* form;
  std::size_t index;  // of its alternative in SettingValue
};

// clang-format off
const KindWords& wordsOf(Kind kind) {
  static const KindWords words[] = {
      {"", "true or false", SettingValue(false).index()},
      {"a ", "whole number", SettingValue(0).index()},
      {"", "", SettingValue(0).index()},
      {"a ", "text", SettingValue(std::string()).index()},
      {"a plain ", "number", SettingValue(0.0).index()},
      {"a ", "number", SettingValue(Expr()).index()},
      {"a ", "number or function", SettingValue(Expr()).index()},
      {"", "{x, y, z}", SettingValue(Vec3E()).index()},
      {"a ", "colour", SettingValue(Vec3E()).index()},
      {"a ", "colour or function", SettingValue(Vec3E()).index()},
      {"", "two corners", SettingValue(Box()).index()}};
  return words[static_cast<int>(kind)];
}
// clang-format on

std::string form(const SettingInfo& f) {
  return f.kind == Kind::Choice ? shown(f.choices) : wordsOf(f.kind).form;
}

std::string ruleWords(const SettingInfo& f) {
  return f.kind == Kind::Integer && f.rule == Rule::Positive ? "1 or more" : wording(f.rule);
}

// The numbers that the value is made of.
std::vector<Expr> numbersOf(const SettingValue& value) {
  if (const int* i = std::get_if<int>(&value)) return {Expr(*i)};
  if (const double* d = std::get_if<double>(&value)) return {*d};
  if (const Expr* e = std::get_if<Expr>(&value)) return {*e};
  if (const Vec3E* v = std::get_if<Vec3E>(&value)) return {v->x, v->y, v->z};
  return {};
}

}  // namespace

std::string wording(const SettingInfo& field) {
  return form(field) + (field.rule == Rule::Any ? "" : ", " + ruleWords(field));
}

std::string written(const SettingInfo& field, const SettingValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (field.kind == Kind::Choice) return "\"" + field.choices.at(std::get<int>(value)) + "\"";
  if (const auto* text = std::get_if<std::string>(&value); text && !text->empty()) return "\"" + *text + "\"";
  const std::vector<Expr> numbers = numbersOf(value);
  if (numbers.empty()) return field.unset;
  const bool grey = numbers.size() > 1 && field.kind != Kind::Vector && numbers[0] == numbers[1] &&
                    numbers[0] == numbers[2];
  if (grey || numbers.size() == 1) return shown(uniformValue(numbers[0]));
  std::string list;
  for (const Expr& e : numbers) list += (list.empty() ? "{" : ", ") + shown(uniformValue(e));
  return list + "}";
}

std::string objection(const SettingInfo& field, const SettingValue& value) {
  const KindWords& words = wordsOf(field.kind);
  const int* const i = std::get_if<int>(&value);
  const bool unknown =
      field.kind == Kind::Choice && i && (*i < 0 || *i >= static_cast<int>(field.choices.size()));
  if (value.index() != words.index || unknown)
    return "must be " + (field.kind == Kind::Choice ? "one of " : std::string(words.article)) + form(field);
  if (const Box* box = std::get_if<Box>(&value))
    return glm::all(glm::lessThan(box->min, box->max))
               ? ""
               : "must have its first corner below the second on every axis";
  const std::vector<Expr> numbers = numbersOf(value);
  double squares = 0.0;
  for (const Expr& e : numbers) {
    const bool onSurface = field.kind == Kind::SurfaceNumber || field.kind == Kind::SurfaceColor;
    if (onSurface && dependsOnSpace(e)) return "";
    if (dependsOnSpace(e)) return "must not depend on the position";
    const double v = uniformValue(e);
    if (!std::isfinite(v)) return std::string("must be ") + wording(Rule::Any) + ", got " + shown(v);
    if (numbers.size() == 1 && !keeps(field.rule, v))
      return "must be " + ruleWords(field) + ", got " + shown(v);
    squares += v * v;
  }
  return numbers.size() == 3 && field.rule == Rule::NotZero && squares == 0.0 ? "must not be {0, 0, 0}" : "";
}

template <class Owner>
Status apply(const Setting<Owner>& setting, const std::map<std::string, SettingValue>& values, Owner& owner) {
  const auto error = [&](const std::string& message) {
    return Error{ErrorKind::Scene, setting.name + message};
  };
  std::vector<std::pair<const SettingField<Owner>*, const SettingValue*>> given;
  for (const auto& [name, value] : values) {
    const auto field = std::ranges::find(setting.fields, name, &SettingInfo::name);
    if (field == setting.fields.end()) return error(": unknown field '" + name + "'");
    const std::string why = objection(*field, value);
    if (!why.empty()) return error((setting.alone ? " " : ": '" + name + "' ") + why);
    given.emplace_back(&*field, &value);
  }
  if (setting.begin) setting.begin(owner);
  for (const auto& [field, value] : given) field->set(owner, *value);
  const std::string why = setting.check ? setting.check(owner) : "";
  return why.empty() ? okStatus() : error(why);
}

template Status apply(const Setting<Scene>&, const std::map<std::string, SettingValue>&, Scene&);
template Status apply(const Setting<Light>&, const std::map<std::string, SettingValue>&, Light&);
template Status apply(const Setting<Material>&, const std::map<std::string, SettingValue>&, Material&);
template Status apply(const Setting<Sky>&, const std::map<std::string, SettingValue>&, Sky&);

// clang-format off
const std::vector<Setting<Scene>>& sceneSettings() {
  static const std::vector<Setting<Scene>> settings{
      {"camera", "camera{from = {3.4, 2.6, 4.6}, to = {0, 0, 0}}",
       "where the scene is seen from; without it all of the scene is in view, if its bounds are finite",
       {field<&Scene::camera, &Camera::from>("from", Kind::Vector, "the eye"),
        field<&Scene::camera, &Camera::to>("to", Kind::Vector, "the point in the middle of the picture"),
        field<&Scene::camera, &Camera::up>("up", Kind::Vector, "the direction that is up in the picture"),
        field<&Scene::camera, &Camera::fov>("fov", Kind::Number, "vertical field of view, below 180 degrees", Rule::Positive),
        field<&Scene::camera, &Camera::mirrored>("mirrored", Kind::Flag, "swaps left and right"),
        field<&Scene::camera, &Camera::aperture>("aperture", Kind::Number, "radius of the lens, scene units: blurs things nearer or farther than the focus; it takes many samples a pixel", Rule::NotNegative),
        field<&Scene::camera, &Camera::focus>("focus", Kind::Number, "the distance along the view at which a lens sees sharply", Rule::Positive, "as far as `to`")},
       false, [](Scene& s) { s.camera.from = s.camera.eye(); },
       [](const Scene& s) -> std::string {
         if (uniformValue(s.camera.fov) >= 180.0) return ": 'fov' must be below 180 degrees";
         const bool same = uniformValue(length(s.camera.eye() - s.camera.to)) == 0.0;
         return same ? ": 'from' and 'to' must be different points" : "";
       }},
      {"ambient", "ambient(color)", "light that comes from everywhere",
       {field<&Scene::ambient>("color", Kind::Color, "")}, true},
      {"background", "background(color)",
       "the colour of rays that hit nothing; in a function, x, y, z are the ray's unit direction",
       {field<&Scene::background>("color", Kind::SurfaceColor, "")}, true},
      {"background_light", "background_light(1)",
       "lets the background light the scene: ambient light by the direction that a surface faces; it replaces `ambient`, or adds to it if that is called too; a factor",
       {field<&Scene::backgroundLight>("strength", Kind::Number, "", Rule::NotNegative)}, true},
      {"fog", "fog{color = c, density = 0.1}",
       "mixes far surfaces into a colour; the share that is kept is exp(-density * distance)",
       {field<&Scene::fog, &Fog::color>("color", Kind::Color, "colour of the fog"),
        field<&Scene::fog, &Fog::density>("density", Kind::Number, "per unit of length", Rule::NotNegative)}},
      {"shadows", "shadows{kind = \"soft\"}", "makes lights cast shadows",
       {field<&Scene::shadow, &Shadow::kind>("kind", Kind::Choice, "method", Rule::Any, "", {"none", "hard", "soft", "improved", "signed"}),
        field<&Scene::shadow, &Shadow::sharpness>("sharpness", Kind::Number, "of soft edges; larger is harder", Rule::Positive),
        field<&Scene::shadow, &Shadow::start>("start", Kind::PlainNumber, "distance from the surface at which the shadow ray starts", Rule::Positive, "0.02; without a camera 0.01 radii of the scene"),
        field<&Scene::shadow, &Shadow::reach>("reach", Kind::PlainNumber, "how far it goes", Rule::Positive, "20; without a camera 10 radii of the scene"),
        field<&Scene::shadow, &Shadow::steps>("steps", Kind::Integer, "readings that a shadow ray may take; a ray that runs out of them counts as dark, and sdfview says so", Rule::Positive)},
       false, [](Scene& s) { s.shadow.kind = Shadow::Kind::Soft; }},
      {"ambient_occlusion", "ambient_occlusion{kind = \"taps\"}", "darkens crevices",
       {field<&Scene::ambientOcclusion, &AmbientOcclusion::kind>("kind", Kind::Choice, "samples along the normal, or the count of steps", Rule::Any, "", {"none", "taps", "steps"}),
        field<&Scene::ambientOcclusion, &AmbientOcclusion::spacing>("spacing", Kind::PlainNumber, "taps: distance between samples", Rule::Positive, "0.08; without a camera 0.04 radii of the scene"),
        field<&Scene::ambientOcclusion, &AmbientOcclusion::count>("count", Kind::Integer, "taps: how many", Rule::Positive),
        field<&Scene::ambientOcclusion, &AmbientOcclusion::strength>("strength", Kind::Number, "taps: weight of each; steps: darkening of each step", Rule::NotNegative)},
       false, [](Scene& s) { s.ambientOcclusion.kind = AmbientOcclusion::Kind::Taps; }},
      {"reflections", "reflections{bounces = 1}", "how often mirrored rays are followed",
       {field<&Scene::reflectionBounces>("bounces", Kind::Integer, "0: no reflections", Rule::NotNegative),
        field<&Scene::glossyReflections>("glossy", Kind::Flag, "mirrors blur as highlights do, by their shininess; it takes many samples a pixel")}},
      {"max_distance", "max_distance(80)", "how far the camera sees, at most 1e15",
       {field<&Scene::maxDistance>("distance", Kind::PlainNumber, "", Rule::Positive, "80; without a camera 40 radii of the scene")}, true, nullptr,
       [](const Scene& s) -> std::string {  // the squares of more are beyond a GPU's floats
         return s.maxDistance > 1e15 ? " must be at most 1e15, got " + shown(*s.maxDistance) : "";
       }},
      {"tone", "tone(\"filmic\")", "how the picture shows light: \"linear\" cuts it off at 1, \"filmic\" bends it so that bright places keep their differences",
       {field<&Scene::tone>("curve", Kind::Choice, "", Rule::Any, "", {"linear", "filmic"})}, true},
      {"gamma", "gamma(2.2)", "exponent of the picture's tone curve; 1 for raw values",
       {field<&Scene::gamma>("exponent", Kind::PlainNumber, "", Rule::Positive, "sRGB")}, true},
      {"bounds", "bounds({x0, y0, z0}, {x1, y1, z1})",
       "the box that an unbounded scene is clipped to when it is meshed",
       {field<&Scene::bounds>("box", Kind::Box, "", Rule::Any, "none")}, true}};
  return settings;
}

const std::vector<Setting<Light>>& lightSettings() {
  static const auto fields = [](const char* vector, const char* doc, Rule rule, const char* radius) {
    return std::vector{field<&Light::vector>(vector, Kind::Vector, doc, rule),
                       field<&Light::color>("color", Kind::Color, "linear RGB"),
                       field<&Light::intensity>("intensity", Kind::Number, "factor of the colour; does not fall off with distance", Rule::NotNegative),
                       field<&Light::castsShadow>("shadow", Kind::Flag, "whether it casts shadows"),
                       field<&Light::radius>("radius", Kind::Number, radius, Rule::NotNegative)};
  };
  static const std::vector<Setting<Light>> settings{
      {"directional_light", "directional_light{direction = {1, 1, 1}}",
       "adds a light from far away; a scene that has no light and calls neither `ambient` nor `background_light` gets a warm one from above that casts a soft shadow, unless `shadows` says which, a weak one from the right, and a grey background if it names none",
       fields("direction", "towards the light", Rule::NotZero, "half the angle that it is seen under, degrees below 90 (the sun's is 0.27): blurs its shadows, whatever their kind; it takes many samples a pixel"), false,
       [](Light& light) { light.kind = Light::Kind::Directional; },
       [](const Light& light) -> std::string {
         return uniformValue(light.radius) >= 90.0 ? ": 'radius' must be below 90 degrees" : "";
       }},
      {"point_light", "point_light{position = {1, 1, 1}}", "adds a light at a point",
       fields("position", "where it is", Rule::Any, "of a ball, scene units: blurs its shadows, whatever their kind; shapes in the ball cast none; it takes many samples a pixel"), false,
       [](Light& light) { light.kind = Light::Kind::Point; }}};
  return settings;
}

const Setting<Material>& materialSetting() {
  static const Setting<Material> setting{
      "material", "material{color = c, shininess = 32}", "how a surface looks",
      {field<&Material::name>("name", Kind::Text, "shown in the exported file", Rule::Any, "\"material N\""),
       field<&Material::color>("color", Kind::SurfaceColor, "diffuse colour"),
       field<&Material::ambient>("ambient", Kind::SurfaceColor, "answer to the ambient light", Rule::Any, "the colour"),
       field<&Material::specular>("specular", Kind::SurfaceColor, "colour of the highlight"),
       field<&Material::shininess>("shininess", Kind::SurfaceNumber, "Phong exponent; larger is tighter", Rule::Positive),
       field<&Material::reflectivity>("reflectivity", Kind::SurfaceNumber, "mirrors reflectivity * (fresnel_bias + (1 - cos)^fresnel_power) of the light, at most all of it; the share that does not depend on the angle is tinted like `specular`", Rule::NotNegative),
       field<&Material::fresnelPower>("fresnel_power", Kind::SurfaceNumber, "larger: only grazing views mirror; cos is that of the angle between view and normal", Rule::NotNegative),
       field<&Material::fresnelBias>("fresnel_bias", Kind::SurfaceNumber, "the share that is mirrored straight on, too", Rule::NotNegative),
       field<&Material::emission>("emission", Kind::SurfaceColor, "light of its own")}};
  return setting;
}

const Setting<Sky>& skySetting() {
  static const Setting<Sky> setting{
      "sky", "sky{horizon = c, zenith = c, sun = {1, 1, 0}}",
      "a background with a horizon and, where its direction is given, a sun",
      {field<&Sky::horizon>("horizon", Kind::Color, "at eye level"),
       field<&Sky::zenith>("zenith", Kind::Color, "straight up"),
       field<&Sky::ground>("ground", Kind::Color, "below the horizon", Rule::Any, "the horizon"),
       field<&Sky::sun>("sun", Kind::Vector, "direction of the sun", Rule::NotZero, "none"),
       field<&Sky::sunColor>("sun_color", Kind::Color, "added where the ray meets the sun"),
       field<&Sky::sunSize>("sun_size", Kind::Number, "exponent of its glow; larger is smaller", Rule::Positive)}};
  return setting;
}
// clang-format on

}  // namespace sdf
