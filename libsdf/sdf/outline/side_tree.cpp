#include "sdf/outline/side_tree.h"

#include <utility>

namespace sdf {

SideTree::SideTree(std::span<const Rectangle> sides) : size_(sides.size()) {
  std::vector<Rectangle> boxes((size_ + kLeaf - 1) / kLeaf);
  for (std::size_t i = 0; i < size_; ++i) boxes[i / kLeaf].add(sides[i]);
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Rectangle>& below = levels_.back();
    std::vector<Rectangle> level((below.size() + 1) / 2);
    for (std::size_t i = 0; i < below.size(); ++i) level[i / 2].add(below[i]);
    levels_.push_back(std::move(level));
  }
}

}  // namespace sdf
