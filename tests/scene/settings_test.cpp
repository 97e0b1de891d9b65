// The tables of settings: each field is what it says, whoever fills it.
#include "sdf/scene/settings.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "support/settings.h"

namespace sdf {
namespace settings_test {

using Kind = SettingKind;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Calls f(setting, owner as it is after `begin`) for every setting.
template <class F>
void forEachSetting(F f) {
  const auto call = [&]<class Owner>(const Setting<Owner>& setting) {
    SCOPED_TRACE(setting.name);
    Owner owner;
    if (setting.begin) setting.begin(owner);
    f(setting, owner);
  };
  for (const Setting<Scene>& s : sceneSettings()) call(s);
  for (const Setting<Light>& s : lightSettings()) call(s);
  call(materialSetting());
  call(skySetting());
}

// A value that keeps every rule and is nobody's default.
SettingValue sample(const SettingInfo& field, const SettingValue& usual) {
  switch (field.kind) {
    case Kind::Flag:
      return !std::get<bool>(usual);
    case Kind::Integer:
      return 7;
    case Kind::Choice:
      return std::get<int>(usual) == 1 ? 2 : 1;
    case Kind::Text:
      return "clay";
    case Kind::PlainNumber:
      return 0.375;
    case Kind::Number:
    case Kind::SurfaceNumber:
      return Expr(0.375);
    case Kind::Vector:
    case Kind::Color:
    case Kind::SurfaceColor:
      return Vec3E(0.375, 0.5, 0.75);
    case Kind::Box:
      break;
  }
  return Box{{-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0}};
}

TEST(SettingTable, EachFieldFillsAMemberOfItsOwn) {
  int count = 0;
  forEachSetting([&]<class Owner>(const Setting<Owner>& setting, const Owner& usual) {
    for (const SettingField<Owner>& field : setting.fields) {
      SCOPED_TRACE(field.name);
      Owner owner;
      const SettingValue value = sample(field, field.get(usual));
      ASSERT_FALSE(same(value, field.get(usual)));
      const Status applied = apply(setting, {{field.name, value}}, owner);
      ASSERT_TRUE(applied) << applied.error().message;
      for (const SettingField<Owner>& other : setting.fields)
        EXPECT_TRUE(same(other.get(owner), &other == &field ? value : other.get(usual))) << other.name;
      ++count;
    }
  });
  EXPECT_GE(count, 40);
}

TEST(SettingTable, NoTwoSettingsFillOneMember) {
  for (const Setting<Scene>& setting : sceneSettings())
    for (const SettingField<Scene>& field : setting.fields) {
      Scene scene;
      ASSERT_TRUE(apply(setting, {{field.name, sample(field, field.get(scene))}}, scene));
      for (const Setting<Scene>& other : sceneSettings())
        for (const SettingField<Scene>& untouched : other.fields)
          EXPECT_TRUE(&other == &setting || same(untouched.get(scene), untouched.get(Scene())))
              << field.name << " " << untouched.name;
    }
}

TEST(SettingTable, NamesAreThereOnceAndEveryLineIsDocumented) {
  std::set<std::string> calls;
  forEachSetting([&]<class Owner>(const Setting<Owner>& setting, const Owner& usual) {
    EXPECT_TRUE(calls.insert(setting.name).second);
    EXPECT_TRUE(setting.usage.starts_with(setting.name));
    EXPECT_FALSE(setting.doc.empty());
    EXPECT_TRUE(!setting.alone || setting.fields.size() == 1);
    std::set<std::string> names;
    for (const SettingField<Owner>& field : setting.fields) {
      EXPECT_TRUE(names.insert(field.name).second) << field.name;
      EXPECT_NE(field.doc.empty(), !setting.alone) << field.name;
      EXPECT_NE(wording(field), "") << field.name;
      const SettingValue value = field.get(usual);
      EXPECT_NE(written(field, value), "") << field.name;
      EXPECT_TRUE(value.index() == 0 || objection(field, value).empty()) << field.name;
    }
  });
}

TEST(SettingTable, AValueOfAnotherKindIsRefused) {
  const std::map<Kind, std::string> wanted{{Kind::Flag, "must be true or false"},
                                           {Kind::Integer, "must be a whole number"},
                                           {Kind::Text, "must be a text"},
                                           {Kind::PlainNumber, "must be a plain number"},
                                           {Kind::Number, "must be a number"},
                                           {Kind::SurfaceNumber, "must be a number or function"},
                                           {Kind::Vector, "must be {x, y, z}"},
                                           {Kind::Color, "must be a colour"},
                                           {Kind::SurfaceColor, "must be a colour or function"},
                                           {Kind::Box, "must be two corners"}};
  const std::vector<SettingValue> values{
      SettingValue(), true, 1, 0.5, "text", Expr(0.5), Vec3E(0.5), Box{glm::dvec3(0.0), glm::dvec3(1.0)}};
  forEachSetting([&]<class Owner>(const Setting<Owner>& setting, const Owner& usual) {
    for (const SettingField<Owner>& field : setting.fields) {
      const SettingValue fitting = sample(field, field.get(usual));
      for (const SettingValue& value : values) {
        if (value.index() == fitting.index()) continue;
        const std::string why =
            field.kind == Kind::Choice ? "must be one of " + wording(field) : wanted.at(field.kind);
        EXPECT_EQ(objection(field, value), why) << field.name << " " << value.index();
        Owner owner;
        const Status applied = apply(setting, {{field.name, value}}, owner);
        ASSERT_FALSE(applied);
        EXPECT_EQ(applied.error().kind, ErrorKind::Scene);
        EXPECT_EQ(applied.error().message,
                  setting.name + (setting.alone ? " " : ": '" + field.name + "' ") + why);
        EXPECT_TRUE(same(field.get(owner), field.get(Owner()))) << "and nothing is set";
      }
    }
  });
}

TEST(SettingTable, ABrokenRuleIsRefused) {
  const auto number = [](const SettingInfo& f, double v) -> SettingValue {
    if (f.kind == Kind::Integer) return static_cast<int>(v);
    if (f.kind == Kind::PlainNumber) return v;
    return Expr(v);
  };
  int rules = 0;
  forEachSetting([&]<class Owner>(const Setting<Owner>& setting, const Owner&) {
    for (const SettingField<Owner>& field : setting.fields) {
      SCOPED_TRACE(field.name);
      const bool whole = field.kind == Kind::Integer;
      if (field.kind == Kind::Vector) {
        EXPECT_EQ(objection(field, Vec3E(0.0)), field.rule == Rule::NotZero ? "must not be {0, 0, 0}" : "");
        EXPECT_EQ(objection(field, Vec3E(1.0, kNaN, 0.0)), "must be a finite number, got nan");
        EXPECT_EQ(objection(field, position()), "must not depend on the position");
      } else if (whole || field.kind == Kind::PlainNumber || field.kind == Kind::Number) {
        const std::string positive = whole ? "must be 1 or more, got " : "must be positive, got ";
        ASSERT_NE(field.rule, Rule::NotZero);
        EXPECT_EQ(objection(field, number(field, 0.0)), field.rule == Rule::Positive ? positive + "0" : "");
        EXPECT_EQ(objection(field, number(field, -2.0)), field.rule == Rule::Positive ? positive + "-2"
                                                         : field.rule == Rule::NotNegative
                                                             ? "must be 0 or more, got -2"
                                                             : "");
        const SettingValue none = whole ? SettingValue(1.0) : number(field, kNaN);
        EXPECT_EQ(objection(field, none),
                  whole ? "must be a whole number" : "must be a finite number, got nan");
        rules += field.rule != Rule::Any;
      } else if (field.kind == Kind::Choice) {
        EXPECT_EQ(objection(field, -1), "must be one of " + wording(field));
        EXPECT_EQ(objection(field, static_cast<int>(field.choices.size())),
                  "must be one of " + wording(field));
      } else if (field.kind == Kind::Box) {
        EXPECT_EQ(objection(field, Box{glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 1.0)}),
                  "must have its first corner below the second on every axis");
      } else if (field.kind == Kind::SurfaceNumber || field.kind == Kind::SurfaceColor) {
        const SettingValue varying =
            field.kind == Kind::SurfaceNumber ? SettingValue(position().x) : SettingValue(position());
        EXPECT_EQ(objection(field, varying), "");
      }
    }
  });
  EXPECT_GE(rules, 10);
}

TEST(SettingTable, FieldsThatContradictEachOtherAreRefused) {
  const auto errorOf = [](const std::string& call, const std::map<std::string, SettingValue>& values) {
    for (const Setting<Scene>& setting : sceneSettings())
      if (Scene scene; setting.name == call) {
        const Status applied = apply(setting, values, scene);
        return applied ? "" : applied.error().message;
      }
    return std::string("no such setting");
  };
  EXPECT_EQ(errorOf("camera", {{"from", Vec3E(1.0)}, {"to", Vec3E(1.0)}}),
            "camera: 'from' and 'to' must be different points");
  EXPECT_EQ(errorOf("camera", {{"fov", Expr(180.0)}}), "camera: 'fov' must be below 180 degrees");
  EXPECT_EQ(errorOf("camera", {{"zoom", Expr(2.0)}}), "camera: unknown field 'zoom'");
  EXPECT_EQ(errorOf("max_distance", {{"distance", 2e15}}), "max_distance must be at most 1e15, got 2e+15");
  EXPECT_EQ(errorOf("max_distance", {{"distance", 1e15}}), "");
}

TEST(SettingTable, ASettingThatIsMadeWithoutFieldsStillSays) {
  Scene scene;
  for (const Setting<Scene>& setting : sceneSettings())
    ASSERT_TRUE(apply(setting, {}, scene)) << setting.name;
  EXPECT_EQ(scene.shadow.kind, Shadow::Kind::Soft);
  EXPECT_EQ(scene.ambientOcclusion.kind, AmbientOcclusion::Kind::Taps);
  EXPECT_FALSE(scene.gamma);
}

}  // namespace settings_test
}  // namespace sdf
