#include "viewer/app/watch.h"

#include <system_error>

namespace sdf::viewer {

Watch::Watch(std::filesystem::path file) : file_(std::move(file)), last_(stamp()) {}

bool Watch::written() {
  const auto now = stamp();
  if (!now || now == last_) return false;
  last_ = now;
  return true;
}

std::optional<Watch::Stamp> Watch::stamp() const {
  std::error_code failed;
  const auto time = std::filesystem::last_write_time(file_, failed);
  if (failed) return std::nullopt;
  const auto size = std::filesystem::file_size(file_, failed);
  if (failed) return std::nullopt;
  return Stamp(time, size);
}

}  // namespace sdf::viewer
