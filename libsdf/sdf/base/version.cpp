#include "sdf/base/version.h"

namespace sdf {

const char* version() { return SDF_VERSION; }

}  // namespace sdf
