#include "sdf/meshfile/mesh_file.h"

#include <algorithm>
#include <system_error>

#include "sdf/base/read_file.h"
#include "sdf/base/utf8.h"
#include "sdf/meshfile/read_mesh.h"

namespace sdf {
namespace {

namespace fs = std::filesystem;

/// Is `inner` below `folder`? Both are canonical.
bool isBelow(const fs::path& folder, const fs::path& inner) {
  return std::mismatch(folder.begin(), folder.end(), inner.begin(), inner.end()).first == folder.end();
}

}  // namespace

Error tooManyTriangles(const fs::path& file) {
  return {ErrorKind::Limits, unreadable(file, "it has more than " + std::to_string(kMostReadTriangles) +
                                                  " triangles; simplify it or split it up")
                                 .message};
}

std::string onOneLine(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  std::string shown = utf8(std::string(text.substr(0, kLongest)));
  std::ranges::replace_if(
      shown, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  return text.size() > kLongest ? shown + "…" : shown;
}

std::string inQuotes(std::string_view text) { return "'" + onOneLine(text) + "'"; }

void warn(std::vector<std::string>& warnings, const std::string& warning) {
  constexpr std::size_t kMost = 20;
  if (warnings.size() > kMost || std::ranges::find(warnings, warning) != warnings.end()) return;
  warnings.push_back(warnings.size() < kMost ? warning : "there are more warnings, left out here");
}

Result<MeshFile> readWhole(const fs::path& file) {
  Result<std::string> bytes = readFile(file, kMostReadBytes, "simplify it or split it up");
  if (!bytes) return bytes.error();
  return MeshFile{file, std::move(*bytes)};
}

Result<MeshFile> readBeside(const fs::path& from, const std::string& name) {
  const auto outside = [&] {
    return unreadable(
        from, "it names the file " + inQuotes(name) + ", which lies outside its folder; move that beside it");
  };
  const fs::path relative(name);
  if (name.find('\0') != name.npos || relative.empty())
    return unreadable(from, "it names the file " + inQuotes(name) + ", which no file can be called");
  if (relative.is_absolute() || *relative.lexically_normal().begin() == "..") return outside();
  std::error_code error;
  const fs::path folder = fs::canonical(from.has_parent_path() ? from.parent_path() : fs::path("."), error);
  if (error) return unreadable(from, error.value());
  const fs::path target = fs::canonical(folder / relative, error);
  if (error) {
    return unreadable(from, "the file " + inQuotes(name) + " that it names: " +
                                std::generic_category().message(error.value()) + "; put it there");
  }
  if (!isBelow(folder, target)) return outside();
  return readWhole(target);
}

}  // namespace sdf
