#include "viewer/render/cell_values.h"

#include <utility>

namespace sdf::viewer {

CellValues::CellValues(CellSorter sorter, std::vector<RowRange> kinds)
    : sorter_(std::move(sorter)), kinds_(std::move(kinds)), inputs_(sorter_.inputs()) {}

bool CellValues::move(const Values& inputs) {
  if (!inputs_.move(inputs)) return false;
  lists_ = sorter_.lists(inputs);
  return true;
}

void CellValues::addTo(std::vector<glm::vec4>& rows) const {
  const std::size_t count = kinds_.size(), width = cellTexels(count), cells = lists_.lists.size() / count + 1;
  const auto stride = [&](std::size_t kind) {
    return isInList(kinds_[kind].stride) ? kinds_[kind].stride : 1;
  };
  // The one behind all is a cell without lists.
  const auto listOf = [&](std::size_t i) {
    return i < lists_.lists.size() ? lists_.lists[i] : CellLists::List{0, 0};
  };
  std::vector<std::size_t> firsts;  // of each kind's lists
  std::size_t end = rows.size() + width * cells;
  for (std::size_t kind = 0; kind < count; ++kind)
    firsts.push_back(std::exchange(end, end + stride(kind) * lists_.entries[kind].size()));
  const std::vector<glm::vec4> own = rows;
  rows.reserve(end);
  for (std::size_t cell = 0; cell < cells; ++cell)
    for (std::size_t kind = 0; kind < 2 * width; ++kind) {
      const auto [begin, many] = kind < count ? listOf(cell * count + kind) : CellLists::List{0, 0};
      const std::size_t at = kind < count ? firsts[kind] + stride(kind) * static_cast<std::size_t>(begin) : 0;
      const std::size_t after = kind < count ? at + stride(kind) * static_cast<std::size_t>(many) : 0;
      if (kind % 2 == 0)
        rows.emplace_back(at, after, 0.0f, 0.0f);
      else
        rows.back().z = static_cast<float>(at), rows.back().w = static_cast<float>(after);
    }
  for (std::size_t kind = 0; kind < count; ++kind)
    for (const int group : lists_.entries[kind]) {
      const std::size_t row = kinds_[kind].first + kinds_[kind].stride * static_cast<std::size_t>(group);
      if (isInList(kinds_[kind].stride))
        rows.insert(rows.end(), own.begin() + static_cast<std::ptrdiff_t>(row),
                    own.begin() + static_cast<std::ptrdiff_t>(row + kinds_[kind].stride));
      else
        rows.emplace_back(row, 0.0f, 0.0f, 0.0f);
    }
}

}  // namespace sdf::viewer
