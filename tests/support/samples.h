// The files of samples/, for the tests that hold every one of them to something.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace sdf::test {

/// The scenes in samples/, sorted; those in its folders are not among them.
inline std::vector<std::filesystem::path> samples() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SDF_SOURCE_DIR "/samples"))
    if (entry.path().extension() == ".lua") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Names a test after its file: "chess".
inline std::string stemOf(const testing::TestParamInfo<std::filesystem::path>& file) { return file.param.stem(); }

}  // namespace sdf::test
