#include "sdf/meshfile/mesh_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "sdf/base/utf8.h"
#include "sdf/meshfile/read_mesh.h"

namespace sdf {
namespace {

namespace fs = std::filesystem;

Error noReading(const fs::path& file, int reason) {
  const char* advice = reason == ENOENT || reason == ENOTDIR ? "check its name" : "check who may read it";
  return unreadable(file, std::generic_category().message(reason) + "; " + advice);
}

Error tooLarge(const fs::path& file, std::uintmax_t bytes) {
  const auto megabytes = [](std::uintmax_t b) { return std::to_string(b / 1'000'000) + " MB"; };
  return {ErrorKind::Limits,
          unreadable(file, "it has " + megabytes(bytes) + ", and files of up to " +
                               megabytes(kMostReadBytes) + " are read; simplify it or split it up")
              .message};
}

/// Is `inner` below `folder`? Both are canonical.
bool isBelow(const fs::path& folder, const fs::path& inner) {
  return std::mismatch(folder.begin(), folder.end(), inner.begin(), inner.end()).first == folder.end();
}

}  // namespace

Error unreadable(const fs::path& file, const std::string& why) {
  return {ErrorKind::Files, "cannot read '" + file.string() + "': " + why};
}

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
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::directory) return unreadable(file, "it is a folder; name a file in it");
  if (!fs::exists(status)) return noReading(file, error ? error.value() : ENOENT);
  if (!fs::is_regular_file(status)) return unreadable(file, "it is no ordinary file; name another");

  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) return noReading(file, errno != 0 ? errno : EACCES);
  MeshFile whole{file, {}};
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return noReading(file, error.value());
  if (size == 0) return unreadable(file, "it is empty");
  if (size > kMostReadBytes) return tooLarge(file, size);
  whole.bytes.resize(size);
  in.read(whole.bytes.data(), static_cast<std::streamsize>(size));
  if (in.gcount() != static_cast<std::streamsize>(size)) return noReading(file, EIO);
  return whole;
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
  if (error) return noReading(from, error.value());
  const fs::path target = fs::canonical(folder / relative, error);
  if (error) {
    return unreadable(from, "the file " + inQuotes(name) + " that it names: " +
                                std::generic_category().message(error.value()) + "; put it there");
  }
  if (!isBelow(folder, target)) return outside();
  return readWhole(target);
}

}  // namespace sdf
