// The operators' part of docs/accuracy.md.
#pragma once
#include <vector>

#include "operator_cases.h"
#include "report.h"

namespace sdf::accuracy {

/// Makes the cases and checks them, as rowOf does.
Row operatorRow(const OperatorCases& cases, std::uint64_t fraction = 1);
/// A row for every operator, in the catalog's order. Takes about a minute on two cores.
std::vector<Row> operatorRows();

}  // namespace sdf::accuracy
