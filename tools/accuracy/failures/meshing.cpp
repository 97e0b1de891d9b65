#include "failure_case.h"
namespace sdf::accuracy {
std::vector<FailureCase> meshingFailures() { return {}; }
}  // namespace sdf::accuracy
