// Runs a program as a user would, and sees what comes of it.
#pragma once
#include <string>
#include <vector>

namespace sdf {

struct Outcome {
  int status = -1;  ///< exit status, or -1 if a signal ended the program
  std::string out, err;
  double seconds = 0.0;            ///< from the start, or from the signal if one was sent, to the end
  bool endedBeforeSignal = false;  ///< the program was faster than signalAfter
};

struct Command {
  std::vector<std::string> words;  ///< the program and its arguments
  long fileSizeLimit = -1;         ///< bytes, like ulimit -f; -1: none
  long memoryLimit = -1;           ///< bytes of addresses, like ulimit -v; -1: none
  bool asNobody = false;           ///< without the superuser's rights
  bool terminal = false;           ///< stderr is a terminal
  double signalAfter = -1.0;  ///< seconds from the first words on stderr to sending `signal`; negative: never
  int signal = 0;

  /// Runs it to the end.
  Outcome run() const;
};

}  // namespace sdf
