#include "operator_rows.h"

namespace sdf::accuracy {

Row operatorRow(const OperatorCases& cases, std::uint64_t fraction) {
  const std::vector<ReferenceCase> made = cases.make();
  std::vector<std::function<ReferenceCase()>> makers;
  for (const ReferenceCase& c : made) makers.emplace_back([&c] { return c; });
  return rowOf(cases.entry, makers, fraction);
}

}  // namespace sdf::accuracy
