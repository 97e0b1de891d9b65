// Results where what was refused must not pass for what holds.
#pragma once
#include <stdexcept>
#include <utility>

#include "sdf/base/result.h"

namespace sdf {

/// The value, or throws std::runtime_error with the error that stands in its place.
template <class T>
T take(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

}  // namespace sdf
