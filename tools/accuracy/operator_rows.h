// The operators' part of docs/accuracy.md.
#pragma once
#include <cstdint>

#include "operator_cases.h"
#include "rows.h"

namespace sdf::accuracy {

/// Makes the cases and checks them, as rowOf does.
Row operatorRow(const OperatorCases& cases, std::uint64_t fraction = 1);

}  // namespace sdf::accuracy
