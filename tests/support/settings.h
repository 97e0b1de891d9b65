// Comparing the values of settings.
#pragma once
#include "sdf/scene/settings.h"

namespace sdf {

inline bool same(const SettingValue& a, const SettingValue& b) {
  return a.index() == b.index() && std::visit(
                                       [&]<class T>(const T& value) {
                                         const T& other = std::get<T>(b);
                                         if constexpr (std::is_same_v<T, Box>)
                                           return value.min == other.min && value.max == other.max;
                                         else
                                           return value == other;
                                       },
                                       a);
}

}  // namespace sdf
