#include "viewer/gpu/shader_log.h"

#include <algorithm>
#include <cstdio>

namespace sdf::viewer {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks(" \t\r\n\0", 5);  // a log ends with a zero
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> lines(std::string_view text) {
  std::vector<std::string_view> found;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    found.push_back(trimmed(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return found;
}

Complaint readLine(const std::string& text, const std::vector<std::string_view>& source) {
  for (const char* const place : {"%*d:%d(%*d): %n", "%*d(%d) : %n", "ERROR: %*d:%d: %n"}) {
    int line = 0;
    int length = -1;
    if (std::sscanf(text.c_str(), place, &line, &length) != 1 || length < 0) continue;
    const bool known = line >= 1 && std::size_t(line) <= source.size();
    return {line, text.substr(std::size_t(length)), known ? std::string(source[std::size_t(line) - 1]) : ""};
  }
  return {0, text, ""};
}

bool isWarning(const Complaint& complaint) { return complaint.text.starts_with("warning"); }

}  // namespace

std::vector<Complaint> readShaderLog(std::string_view log, std::string_view source) {
  const auto sourceLines = lines(source);
  std::vector<Complaint> complaints;
  for (const std::string_view line : lines(log))
    if (!line.empty()) complaints.push_back(readLine(std::string(line), sourceLines));
  std::erase_if(complaints, isWarning);
  return complaints;
}

std::string describe(const std::vector<Complaint>& complaints) {
  constexpr std::size_t kMost = 3;            // what follows the first is seldom news
  constexpr std::size_t kLongestQuote = 200;  // generated lines can be very long
  std::string all;
  for (std::size_t i = 0; i < std::min(kMost, complaints.size()); ++i) {
    const auto& [line, text, source] = complaints[i];
    if (i > 0) all += "; ";
    if (line > 0) all += "line " + std::to_string(line) + ": ";
    all += text;
    if (!source.empty()) all += " in '" + source.substr(0, kLongestQuote) + "'";
  }
  if (complaints.size() > kMost) all += "; and " + std::to_string(complaints.size() - kMost) + " more";
  return all;
}

}  // namespace sdf::viewer
