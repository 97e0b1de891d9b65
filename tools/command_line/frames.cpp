#include "command_line/frames.h"

#include <cstdio>
#include <regex>
#include <string>

namespace sdf::command_line {
namespace {

/// Where the number goes in a file name; the first group is the N of %0Nd.
const std::regex& numberPlace() {
  static const std::regex place("%(?:0([1-9]))?d");
  return place;
}

std::string padded(int number, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%0*d", digits, number);
  return text;
}

}  // namespace

Status checkFrameName(const std::filesystem::path& output) {
  const std::string name = output.filename().string();
  const std::sregex_iterator places(name.begin(), name.end(), numberPlace());
  if (std::distance(places, {}) > 1)
    return Error{ErrorKind::Usage,
                 "'" + output.string() + "' has more than one place for the frame's number; keep one %04d"};
  return okStatus();
}

std::filesystem::path frameName(const std::filesystem::path& output, int number) {
  const std::string name = output.filename().string();
  std::filesystem::path numbered = output;
  std::smatch place;
  if (!std::regex_search(name, place, numberPlace()))
    return numbered.replace_filename(output.stem().string() + "_" + padded(number, 4) +
                                     output.extension().string());
  const int digits = place[1].matched ? std::stoi(place[1]) : 1;
  return numbered.replace_filename(place.prefix().str() + padded(number, digits) + place.suffix().str());
}

}  // namespace sdf::command_line
