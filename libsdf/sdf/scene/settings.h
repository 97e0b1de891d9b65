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

/// The kind of value that a field takes.
enum class SettingKind {
  Flag,           ///< true or false
  Integer,        ///< a whole number
  Choice,         ///< one of SettingInfo::choices
  Text,           ///< a string
  PlainNumber,    ///< a number that depends on nothing
  Number,         ///< a number that may depend on parameters
  SurfaceNumber,  ///< a number that may depend on parameters, the position and the normal
  Vector,         ///< {x, y, z} that may depend on parameters
  Color,          ///< linear RGB that may depend on parameters
  SurfaceColor,   ///< linear RGB that may depend on parameters, the position and the normal
  Box             ///< two corners
};

/// A field's value: bool for Flag, int for Integer and for a Choice's index, double for PlainNumber;
/// monostate for a field that is unset.
using SettingValue = std::variant<std::monostate, bool, int, double, std::string, Expr, Vec3E, Box>;

/// A field's description, which does not depend on its owner.
struct SettingInfo {
  std::string name;  ///< snake_case, as in scene files
  SettingKind kind = SettingKind::Number;
  std::string doc;                   ///< one line
  Rule rule = Rule::Any;             ///< of its numbers; a Vector's NotZero is about its length
  std::vector<std::string> choices;  ///< of a Choice
  std::string unset;                 ///< the effect of leaving it unset, worded like a default
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
