// Numbers as text.
#pragma once
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

namespace sdf::command_line {

/// printf's text, of less than 256 bytes.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// A count with commas between thousands.
inline std::string grouped(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

}  // namespace sdf::command_line
