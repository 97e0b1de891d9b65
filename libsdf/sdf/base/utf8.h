// Text for JSON.
#pragma once
#include <string>

namespace sdf {

/// The text with bytes that are not UTF-8 replaced by U+FFFD: JSON is UTF-8 (RFC 8259), names are any bytes.
std::string utf8(const std::string& text);

}  // namespace sdf
