// The library's own version.
#pragma once

namespace sdf {

/// "major.minor.patch", as in the files that it writes.
const char* version();

}  // namespace sdf
