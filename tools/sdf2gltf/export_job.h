// The program's work: a scene file in, one or more mesh files and a report out.
#pragma once
#include <ostream>

#include "command_line/progress_line.h"
#include "options.h"

namespace sdf::exporter {

using command_line::ProgressLine;

/// Does what `options` ask for and prints a table for each file to `out` unless quiet. Errors as the
/// functions it calls.
Status runExport(const Options& options, ProgressLine& progress, std::ostream& out);

}  // namespace sdf::exporter
