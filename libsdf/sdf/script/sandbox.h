// The bounds within which a scene script runs: what it can name, and how much it may use.
#pragma once
#include <string>

#include "sdf/base/result.h"
#include "sdf/script/context.h"

namespace sdf {

/// Runs `text` with the scene language's functions in reach and nothing else, and fills context.scene. The
/// error names file and line. Shapes that the script returns become unnamed parts.
Status runInSandbox(ScriptContext& context, const std::string& text);

}  // namespace sdf
