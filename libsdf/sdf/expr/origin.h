// Where the nodes of a graph come from, for messages.
#pragma once
#include <cstdint>
#include <string>

#include "sdf/expr/expr.h"

namespace sdf {

/// While it lives, the nodes that this thread makes come from `what` in this line of a file; within another
/// one, those made while both live from the inner one. What rewrite makes anew of a node comes from where
/// that came from. A node that several make is the first one's.
class Origin {
 public:
  Origin(const char* what, const std::string& file, int line);
  /// From where this node comes.
  explicit Origin(const Expr& like);
  ~Origin();
  Origin(const Origin&) = delete;
  Origin& operator=(const Origin&) = delete;

 private:
  std::uint32_t before_;
};

/// "the twist at scene.lua:4"; "" where nothing is known.
std::string originOf(const Expr& e);

}  // namespace sdf
