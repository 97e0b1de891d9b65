// The end of memory.
#pragma once

namespace sdf::command_line {

/// From now on the program ends with a message and the status of a limit (ErrorKind::Limits) where memory is
/// used up, in whatever thread that is. `program` begins the message, and must outlive the program; `advice`
/// says what to do.
void endWhereMemoryEnds(const char* program, const char* advice);

}  // namespace sdf::command_line
