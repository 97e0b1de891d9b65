// The files of samples/, for the tests that hold every one of them to something.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace sdf::test {

/// The scenes in samples/ that Iterator goes through, sorted.
template <class Iterator = std::filesystem::directory_iterator>
std::vector<std::filesystem::path> samples() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : Iterator(SDF_SOURCE_DIR "/samples"))
    if (entry.path().extension() == ".lua") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}
/// Those in its folders, too.
inline std::vector<std::filesystem::path> allSamples() {
  return samples<std::filesystem::recursive_directory_iterator>();
}

/// Names a test after its file: "chess".
inline std::string stemOf(const testing::TestParamInfo<std::filesystem::path>& file) {
  return file.param.stem();
}

}  // namespace sdf::test
