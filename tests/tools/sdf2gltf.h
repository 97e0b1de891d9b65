// What the tests of the command line share.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "command.h"
#include "support/folder.h"

namespace sdf {

/// A folder of the test's own with scene files in it and an `out` folder beside them.
class Sdf2gltf : public testing::Test {
 protected:
  Sdf2gltf() { std::filesystem::create_directory(folder / "out"); }

  /// Path of a new scene file with this text.
  std::string scene(const std::string& text) {
    const auto file = folder / ("scene" + std::to_string(++scenes_) + ".lua");
    std::ofstream(file) << text;
    return file.string();
  }
  std::string out(const std::string& name) const { return (folder / ("out/" + name)).string(); }

  static Command command(std::vector<std::string> arguments) {
    Command command;
    command.words = {SDF2GLTF_PROGRAM};
    command.words.insert(command.words.end(), arguments.begin(), arguments.end());
    return command;
  }
  static Outcome run(std::vector<std::string> arguments) { return runCommand(command(std::move(arguments))); }
  static Outcome runCommand(const Command& command) {
    Outcome outcome = command.run();
    outcome.err = withoutProgress(outcome.err);
    return outcome;
  }

  /// What is said of progress where stderr is no terminal depends on how fast the machine is.
  static std::string withoutProgress(const std::string& said) {
    std::istringstream lines(said);
    std::string rest;
    for (std::string line; std::getline(lines, line);)
      if (!line.starts_with("sdf2gltf: after ")) rest += line + "\n";
    return rest;
  }

  /// Names in the `out` folder, sorted.
  std::vector<std::string> written() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  const Folder folder;

  static constexpr const char* kSphere = "return sphere(1)";
  static constexpr const char* kTwoParts =
      "part('ball', sphere(1):paint({1, 0, 0}))\n"
      "part('block', box({0.5, 0.5, 0.5}):translate({2, 0, 0}):paint({0, 0, 1}))";

 private:
  int scenes_ = 0;
};

}  // namespace sdf
