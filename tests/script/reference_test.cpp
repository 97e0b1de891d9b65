// The language's page tells the truth: its reference is what the code yields, and its examples run.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "script/run.h"
#include "sdf/scene/settings.h"
#include "sdf/script/reference.h"
#include "sdf/shape/catalog.h"

namespace sdf {
namespace reference_test {

std::string read(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::string(SDF_SOURCE_DIR) + "/" + name, std::ios::binary).rdbuf();
  return text.str();
}

TEST(Reference, ThePageIsWhatTheCodeYields) {
  const std::string page = read("docs/scene-language.md");
  const Result<std::string> fresh = withSceneReference(page);
  ASSERT_TRUE(fresh) << fresh.error().message;
  EXPECT_TRUE(*fresh == page) << "run: scene_reference docs/scene-language.md";
}

// The names that a function takes by name, from what the language answers to one that it does not know.
std::vector<std::string> namesTakenBy(const std::string& function) {
  const std::string answer = errorOf(function + "{qqqqqq = 1}"), before = "it takes ";
  std::string list = answer.substr(answer.find(before) + before.size());
  for (std::size_t at; (at = list.find(" and ")) != std::string::npos;) list.replace(at, 5, ", ");
  std::vector<std::string> names;
  for (std::size_t at = 0, end; at < list.size(); at = end + 2) {
    end = std::min(list.find(", ", at), list.size());
    names.push_back(list.substr(at, end - at));
  }
  return names;
}

// What stands on the page behind "- `name`: ", down to the end of the line; "" where there is no such line.
std::string lineOf(const std::string& section, const std::string& name) {
  const std::string before = "- `" + name + "`: ";
  const std::size_t at = section.find(before);
  return at == std::string::npos
             ? ""
             : section.substr(at + before.size(), section.find('\n', at) - at - before.size());
}

// The default that a line names, in the language's own words.
std::string defaultIn(const std::string& line) {
  const std::string before = "; default `";
  const std::size_t at = line.find(before);
  return at == std::string::npos ? "" : line.substr(at + before.size(), line.rfind('`') - at - before.size());
}

// An argument for a parameter that must be given, by what the page says that it takes.
std::string argumentFor(const std::string& line) {
  const bool flat = line.find("flat") != std::string::npos;
  for (const auto& [form, text] : std::initializer_list<std::pair<const char*, const char*>>{
           {"(points", "{{0, 0}, {1, 0}, {0, 1}}"},
           {"(shapes", "{sphere(1), box(0.5, 0.6, 0.7)}"},
           {"(shape", flat ? "rectangle(0.5, 0.3)" : "box(0.5, 0.6, 0.7)"},
           {"(whole number", "3"},
           {"(number", "0.5"},
           {"(`{x, y", "{2, 1, 3}"}})
    if (line.find(form) != std::string::npos)
      return line.find("{x, y}") == std::string::npos ? text : "{2, 1}";
  return "nil";
}

// The distance of a shape, flat or not, that a call makes.
Expr distanceOf(const std::string& call) {
  const Result<Scene> solid = runScene("return " + call, "scene.lua");
  const bool flat = !solid && solid.error().message.find("is flat") != std::string::npos;
  return solid ? solid->parts.at(0).shape.distance
               : sceneOf("return " + call + (flat ? ":extrude(1)" : "")).whole().distance;
}

TEST(Reference, EveryParameterIsOnThePageWithTheDefaultThatItHas) {
  const std::string page = read("docs/scene-language.md");
  int defaults = 0;
  for (const CatalogEntry& entry : catalog()) {
    SCOPED_TRACE(entry.name);
    const std::size_t heading = page.find("\n#### `" + entry.name + "(");
    ASSERT_NE(heading, std::string::npos);
    const std::string section = page.substr(heading, page.find("\n##", heading + 1) - heading);
    const std::vector<std::string> names = namesTakenBy(entry.name);
    std::string required;
    for (const std::string& name : names) {
      const std::string line = lineOf(section, name);
      ASSERT_NE(line, "") << name;
      const bool needed = !line.ends_with("; optional)") && defaultIn(line).empty();
      if (needed) required += name + " = " + argumentFor(line) + ", ";
    }
    const Expr usual = distanceOf(entry.name + "{" + required + "}");
    for (const std::string& name : names) {
      const std::string text = defaultIn(lineOf(section, name));
      if (text.empty()) continue;
      EXPECT_TRUE(distanceOf(entry.name + "{" + required + name + " = " + text + "}") == usual) << name;
      ++defaults;
    }
  }
  EXPECT_GE(defaults, 20);
}

TEST(Reference, EverySettingIsOnThePageWithItsDefaults) {
  const std::string page = read("docs/scene-language.md");
  const auto expectLines = [&]<class Owner>(const Setting<Owner>& setting) {
    Owner usual;
    if (setting.begin) setting.begin(usual);
    const std::size_t heading = page.find("\n- `" + setting.usage + "`: " + setting.doc);
    ASSERT_NE(heading, std::string::npos) << setting.name;
    const std::string section =
        page.substr(heading, std::min(page.find("\n- ", heading + 1), page.find("\n\n", heading)) - heading);
    for (const SettingField<Owner>& field : setting.fields) {
      const std::string worth = " (" + wording(field) + "; default " + written(field, field.get(usual)) + ")";
      if (setting.alone)
        EXPECT_EQ(section, "\n- `" + setting.usage + "`: " + setting.doc + worth);
      else
        EXPECT_EQ(lineOf(section, field.name), field.doc + worth) << setting.name << " " << field.name;
    }
  };
  for (const Setting<Scene>& setting : sceneSettings()) expectLines(setting);
  for (const Setting<Light>& setting : lightSettings()) expectLines(setting);
  expectLines(materialSetting());
  expectLines(skySetting());
}

TEST(Reference, EveryGlobalNameIsOnThePage) {
  const std::string page = read("docs/scene-language.md");
  ScriptOptions options;
  const Scene scene = sceneOf("for name in pairs(_ENV) do part(name, sphere(1)) end", options);
  EXPECT_GT(scene.parts.size(), catalog().size());
  for (const Part& part : scene.parts) {
    const bool found =
        page.find("`" + part.name) != std::string::npos || page.find(":" + part.name) != std::string::npos;
    EXPECT_TRUE(found || part.name == "pi") << part.name << " is not on the page";
  }
  EXPECT_NE(page.find("pi * time"), std::string::npos);
}

int runExamples(const std::string& name) {
  const std::string page = read(name), fence = "```lua\n";
  int count = 0;
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1), ++count) {
    const std::size_t begin = at + fence.size();
    std::string example = page.substr(begin, page.find("```", begin) - begin);
    sceneOf(example);
  }
  return count;
}

TEST(Reference, EveryExampleOnThePageRuns) { EXPECT_GE(runExamples("docs/scene-language.md"), 5); }
TEST(Reference, EveryExampleInTheReadmeRuns) { EXPECT_GE(runExamples("README.md"), 1); }

TEST(Reference, APageWithoutMarkersIsRefused) {
  const Result<std::string> page = withSceneReference("# nothing here");
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().message, "the page lacks the lines that mark the reference");
}

}  // namespace reference_test
}  // namespace sdf
