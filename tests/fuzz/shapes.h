// Shapes decoded from bytes: trees of catalog entries, mostly with arguments that they accept.
#pragma once
#include "fuzz/bytes.h"
#include "sdf/shape/catalog.h"

namespace sdf::fuzz {

struct FuzzedShape {
  Shape shape;
  bool moderate;  ///< no number was beyond a few units or finer than 1/64, so that floats hold all there is
};

/// Up to `most` entries, each over those before; in the end all are united. Entries that refuse their
/// arguments are left out. A failed shape means that none was left.
FuzzedShape readShape(Bytes& bytes, int most);

}  // namespace sdf::fuzz
