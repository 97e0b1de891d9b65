// The kept inputs through their targets, and the dictionary held to the scene language.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "fuzz/targets.h"
#include "sdf/script/script.h"
#include "sdf/shape/catalog.h"
#include "support/folder.h"

namespace sdf::fuzz {
namespace corpus_test {

const std::filesystem::path kFolder = std::filesystem::path(SDF_SOURCE_DIR) / "tests/fuzz";

// A find aborts, so the test's last line names the input.
void replay(const std::string& target, void (*run)(Input)) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder / "corpus" / target))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    std::cerr << file.filename().string() << std::endl;
    const std::string bytes = contents(file);
    run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  }
}

TEST(Corpus, SceneTextsRunOrFailWithALine) { replay("script", script); }
TEST(Corpus, GraphsReadAlikeByEveryReading) { replay("graph", graph); }
TEST(Corpus, ShapesBecomeSoundMeshesAndFiles) { replay("meshed", meshed); }
TEST(Corpus, MeshFilesReadOrFailWithALine) { replay("files", files); }

// The corpus is for every checkout: small, and quick to run.
TEST(Corpus, StaysSmall) {
  constexpr std::uintmax_t kMostFiles = 300, kMostBytes = 1'000'000;
  std::uintmax_t files = 0, bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kFolder / "corpus"))
    if (entry.is_regular_file()) ++files, bytes += entry.file_size();
  EXPECT_LT(files, kMostFiles);
  EXPECT_LT(bytes, kMostBytes);
}

// Whatever a scene can name, the names of arguments and the choices among them.
std::set<std::string> namesOfTheLanguage() {
  const Result<Scene> scene = runScene(R"(
    for name, value in pairs(_ENV) do
      part(name, sphere(1))
      if type(value) == "table" then for field in pairs(value) do part(name .. "." .. field, sphere(1)) end end
    end)",
                                       "names.lua");
  std::set<std::string> names;
  for (const Part& p : scene->parts) names.insert(p.name);
  for (const CatalogEntry& e : catalog())
    for (const sdf::Parameter& p : e.parameters) {
      names.insert(p.name);
      names.insert(p.choices.begin(), p.choices.end());
    }
  return names;
}

TEST(Dictionary, HasEveryNameOfTheSceneLanguage) {
  const std::string dictionary = contents(kFolder / "script.dict");
  std::string missing;
  for (const std::string& name : namesOfTheLanguage())
    if (dictionary.find('"' + name + '"') == std::string::npos) missing += '"' + name + "\"\n";
  EXPECT_EQ(missing, "") << "add these lines to tests/fuzz/script.dict";
}

}  // namespace corpus_test
}  // namespace sdf::fuzz
