#include "command_line/memory.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <new>

#include "sdf/base/result.h"

namespace sdf::command_line {
namespace {

const char *thisProgram = "", *whatToDo = "";

// Takes no memory itself.
void end() {
  for (const char* text : {thisProgram, ": the memory is used up; ", whatToDo, "\n"})
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  std::_Exit(static_cast<int>(ErrorKind::Limits));
}

}  // namespace

void endWhereMemoryEnds(const char* program, const char* advice) {
  thisProgram = program, whatToDo = advice;
  std::set_new_handler(end);
}

}  // namespace sdf::command_line
