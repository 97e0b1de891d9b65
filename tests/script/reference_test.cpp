// The language's page tells the truth: its reference is what the code yields, and its examples run.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "script/run.h"
#include "sdf/script/reference.h"
#include "sdf/shape/catalog.h"

namespace sdf {
namespace {

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

TEST(Reference, EveryEntryAndParameterIsThere) {
  const std::string text = sceneReference();
  for (const CatalogEntry& entry : catalog()) {
    const std::size_t heading = text.find("\n#### `" + entry.name + "(");
    ASSERT_NE(heading, std::string::npos) << entry.name;
    const std::string section = text.substr(heading, text.find("\n####", heading + 1) - heading);
    for (const Parameter& p : entry.parameters)
      EXPECT_NE(section.find("\n- `" + p.name + "`: "), std::string::npos) << entry.name << " " << p.name;
  }
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

}  // namespace
}  // namespace sdf
