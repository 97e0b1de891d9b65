#include "sdf/base/utf8.h"

#include <bit>
#include <cstdint>

namespace sdf {

std::string utf8(const std::string& text) {
  // Unicode, table 3-7: no over-long forms, no surrogates, nothing above U+10FFFF.
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // by length
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto at = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]); };
    const int ones = std::countl_one(at(0));
    const std::size_t length = ones == 0 ? 1 : ones;
    bool valid = ones != 1 && ones <= 4 && i + length <= text.size();
    std::uint32_t code = ones == 0 ? at(0) : at(0) & (0x7F >> ones);
    for (std::size_t k = 1; valid && k < length; ++k) {
      valid = (at(k) & 0xC0) == 0x80;
      code = code << 6 | (at(k) & 0x3F);
    }
    valid = valid && code >= kLeast[length] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
    out += valid ? text.substr(i, length) : "\xEF\xBF\xBD";
    i += valid ? length : 1;
  }
  return out;
}

}  // namespace sdf
