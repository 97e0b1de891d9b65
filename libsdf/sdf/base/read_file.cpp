#include "sdf/base/read_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace sdf {

namespace fs = std::filesystem;

Error unreadable(const fs::path& file, const std::string& why) {
  return {ErrorKind::Files, "cannot read '" + file.string() + "': " + why};
}

Error unreadable(const fs::path& file, int reason) {
  const char* advice = reason == ENOENT || reason == ENOTDIR ? "check its name" : "check who may read it";
  return unreadable(file, std::generic_category().message(reason) + "; " + advice);
}

Result<std::string> readFile(const fs::path& file, std::uintmax_t most, const std::string& advice) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::directory) return unreadable(file, "it is a folder; name a file in it");
  if (!fs::exists(status)) return unreadable(file, error ? error.value() : ENOENT);
  if (!fs::is_regular_file(status)) return unreadable(file, "it is no ordinary file; name another");

  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) return unreadable(file, errno != 0 ? errno : EACCES);
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return unreadable(file, error.value());
  if (size == 0) return unreadable(file, "it is empty");
  if (size > most) {
    const auto megabytes = [](std::uintmax_t b) { return std::to_string(b / 1'000'000) + " MB"; };
    const std::string why =
        "it has " + megabytes(size) + ", and files of up to " + megabytes(most) + " are read; " + advice;
    return Error{ErrorKind::Limits, unreadable(file, why).message};
  }
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (in.gcount() != static_cast<std::streamsize>(size)) return unreadable(file, EIO);
  return bytes;
}

}  // namespace sdf
