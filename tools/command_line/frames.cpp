#include "command_line/frames.h"

#include <algorithm>
#include <optional>
#include <string>

namespace sdf::command_line {
namespace {

/// Where the number goes in a file name: the place and length of its %d or %0Nd, if it has one.
struct NumberPlace {
  std::size_t begin, length;
  int digits;
};

std::optional<NumberPlace> numberPlace(const std::string& name, std::size_t from = 0) {
  const std::size_t begin = name.find('%', from);
  if (begin == std::string::npos) return std::nullopt;
  std::size_t end = begin + 1;
  int digits = 1;
  if (end + 1 < name.size() && name[end] == '0' && name[end + 1] >= '1' && name[end + 1] <= '9') {
    digits = name[end + 1] - '0';
    end += 2;
  }
  if (end < name.size() && name[end] == 'd') return NumberPlace{begin, end + 1 - begin, digits};
  return numberPlace(name, begin + 1);
}

}  // namespace

Status checkFrameName(const std::filesystem::path& output) {
  const std::string name = output.filename().string();
  const std::optional<NumberPlace> first = numberPlace(name);
  if (first && numberPlace(name, first->begin + first->length))
    return Error{ErrorKind::Usage,
                 "'" + output.string() + "' has more than one place for the frame's number; keep one %04d"};
  return okStatus();
}

std::filesystem::path frameName(const std::filesystem::path& output, int number) {
  const std::string name = output.filename().string(), digits = std::to_string(number);
  const auto padded = [&](int width) {
    const auto missing = std::max<std::ptrdiff_t>(0, width - static_cast<std::ptrdiff_t>(digits.size()));
    return std::string(static_cast<std::size_t>(missing), '0') + digits;
  };
  const std::optional<NumberPlace> place = numberPlace(name);
  std::filesystem::path numbered = output;
  if (place) {
    numbered.replace_filename(std::string(name).replace(place->begin, place->length, padded(place->digits)));
  } else {
    numbered.replace_filename(output.stem().string() + "_" + padded(4) + output.extension().string());
  }
  return numbered;
}

}  // namespace sdf::command_line
