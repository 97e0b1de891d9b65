// What can be said of a scene besides its shapes, as data: the settings, what each takes, and which members
// it fills. The scene language and its reference page are made from these tables.
#pragma once
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "sdf/scene/patterns.h"
#include "sdf/scene/scene.h"
#include "sdf/shape/catalog.h"

namespace sdf {

/// What a field takes. A Number, a Vector and a Color may depend on parameters; SurfaceNumber and
/// SurfaceColor also on the position and the normal.
// clang-format off
enum class SettingKind {
  Flag, Integer, Choice, Text, PlainNumber, Number, SurfaceNumber, Vector, Color, SurfaceColor, Box
};
// clang-format on

/// What a field holds: bool for Flag, int for Integer and for a Choice's index, double for PlainNumber;
/// monostate where it may be unset and is.
using SettingValue = std::variant<std::monostate, bool, int, double, std::string, Expr, Vec3E, Box>;

/// What there is to know of a field, whatever it belongs to.
struct SettingInfo {
  std::string name;  ///< snake_case, as in scene files
  SettingKind kind = SettingKind::Number;
  std::string doc;                   ///< one line
  Rule rule = Rule::Any;             ///< of its numbers; a Vector's NotZero is about its length
  std::vector<std::string> choices;  ///< of a Choice
  std::string unset;                 ///< what happens where it is unset, as a default is worded
};

/// What the field takes, in words: "number, positive".
std::string wording(const SettingInfo& field);
/// The value as scene files write it.
std::string written(const SettingInfo& field, const SettingValue& value);
/// Why the field cannot take the value: "must be positive, got -1". Empty where it can.
std::string objection(const SettingInfo& field, const SettingValue& value);

template <class Owner>
struct SettingField : SettingInfo {
  SettingValue (*get)(const Owner&);
  void (*set)(Owner&, const SettingValue&);  ///< expects a value without objection
};

/// One call of the scene language, which fills members of its Owner.
template <class Owner>
struct Setting {
  std::string name;
  std::string usage;  ///< as written in a scene
  std::string doc;
  std::vector<SettingField<Owner>> fields;
  bool alone = false;  ///< the only field stands without its name: gamma(2.2)
  /// What the call changes before any field; nullptr where it means nothing without fields.
  void (*begin)(Owner&) = nullptr;
  /// What is wrong with the fields taken together, or "".
  std::string (*check)(const Owner&) = nullptr;
};

/// Camera, ambient light, fog and so on, each to be made once.
const std::vector<Setting<Scene>>& sceneSettings();
/// The kinds of lights, of which a scene may have any number.
const std::vector<Setting<Light>>& lightSettings();
const Setting<Material>& materialSetting();
const Setting<Sky>& skySetting();

/// Fills the members that `values` name. An error, "camera: 'fov' must be positive, got -1", is of kind
/// Scene; values that contradict each other are found when they are set already.
template <class Owner>
Status apply(const Setting<Owner>& setting, const std::map<std::string, SettingValue>& values, Owner& owner);

}  // namespace sdf
