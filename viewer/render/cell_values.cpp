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
  const std::size_t kinds = kinds_.size(), width = cellTexels(kinds), cells = lists_.lists.size() / kinds;
  const std::vector<glm::vec4> own = rows;
  rows.resize(own.size() + width * cells);
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    const RowRange& range = kinds_[kind];
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const auto [begin, count] = lists_.lists[cell * kinds + kind];
      const std::size_t at = rows.size() + range.listed() * static_cast<std::size_t>(begin);
      glm::vec4& texel = rows[own.size() + cell * width + kind / 2];
      const glm::length_t place = kind % 2 == 0 ? 0 : 2;
      texel[place] = static_cast<float>(at);
      texel[place + 1] = static_cast<float>(at + range.listed() * static_cast<std::size_t>(count));
    }
    for (const int group : lists_.entries[kind]) {
      const std::size_t row = range.first + range.stride * static_cast<std::size_t>(group);
      if (range.isInLists())
        rows.insert(rows.end(), &own[row], &own[row] + range.stride);
      else
        rows.emplace_back(row, 0.0f, 0.0f, 0.0f);
    }
  }
}

}  // namespace sdf::viewer
