#include "command_line/memory.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

#include "sdf/base/result.h"

namespace sdf::command_line {
namespace {

const char *thisProgram = "", *whatToDo = "";

std::atomic_flag ending = ATOMIC_FLAG_INIT;

// Takes no memory itself. Memory ends for all threads at once; the first one speaks, the others wait for the
// end.
void end() {
  while (ending.test_and_set()) ::pause();
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
