// The program's work: a scene file in, one or more mesh files and a report out.
#pragma once
#include <ostream>

#include "options.h"
#include "progress_line.h"

namespace sdf::exporter {

/// Does what `options` ask for and prints a table for each file to `out` unless quiet. Errors as the
/// functions it calls.
Status runExport(const Options& options, ProgressLine& progress, std::ostream& out);

}  // namespace sdf::exporter
