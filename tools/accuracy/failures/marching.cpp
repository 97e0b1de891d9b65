#include "failure_case.h"
namespace sdf::accuracy {
std::vector<FailureCase> marchingFailures() { return {}; }
}  // namespace sdf::accuracy
