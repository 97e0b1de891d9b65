// Every solid and flat shape of the catalog beside its geometry, at several arguments, extreme ones among
// them.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "accuracy/check.h"

namespace sdf::accuracy {

/// What one catalog entry is held to. Cases are made one at a time, since their meshes are large; making one
/// takes up to a second.
struct PrimitiveCases {
  std::string entry;
  std::vector<std::function<ReferenceCase()>> makers;
};

/// In the catalog's order: every solid and flat entry.
const std::vector<PrimitiveCases>& primitiveCases();

}  // namespace sdf::accuracy
