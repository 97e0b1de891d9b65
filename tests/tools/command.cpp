#include "command.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <stdexcept>

namespace sdf {
namespace {

using Clock = std::chrono::steady_clock;
constexpr uid_t kNobody = 65534;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The end we read from, and the one that the program writes to.
struct Channel {
  int read = -1, write = -1;
};

Channel openChannel(bool terminal) {
  Channel channel;
  std::array<int, 2> ends;
  const int failed = terminal ? ::openpty(&channel.read, &channel.write, nullptr, nullptr, nullptr)
                              : ::pipe2(ends.data(), O_CLOEXEC);
  if (failed) throw std::runtime_error("no channel to the program");
  if (!terminal) channel = {ends[0], ends[1]};
  return channel;
}

[[noreturn]] void becomeProgram(const Command& command, int out, int err) {
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  const auto limitTo = [](auto resource, long most) {
    if (most < 0) return;
    const rlimit limit{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
    ::setrlimit(resource, &limit);
  };
  limitTo(RLIMIT_FSIZE, command.fileSizeLimit);
  limitTo(RLIMIT_AS, command.memoryLimit);
  // Opened first: nobody may not be let into the folders above the program, such as root's home.
  const int program = ::open(command.words[0].c_str(), O_RDONLY | O_CLOEXEC);
  if (command.asNobody && ::geteuid() == 0 && ::setuid(kNobody) != 0) ::_exit(126);
  ::signal(SIGINT, SIG_DFL);  // ignored in what a shell starts in the background
  std::vector<char*> words;
  for (const std::string& word : command.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  ::fexecve(program, words.data(), environ);
  ::_exit(127);
}

/// Appends what can be read; false at the end. (Linux ends a terminal with EIO once its program has left.)
bool drain(int descriptor, std::string& text) {
  std::array<char, 4096> buffer;
  const ssize_t n = ::read(descriptor, buffer.data(), buffer.size());
  if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
  return n > 0;
}

}  // namespace

Outcome Command::run() const {
  Channel out = openChannel(false), err = openChannel(terminal);
  auto start = Clock::now(), firstWords = start;
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process for the program");
  if (child == 0) becomeProgram(*this, out.write, err.write);
  ::close(out.write);
  ::close(err.write);

  Outcome outcome;
  bool toSend = signalAfter >= 0.0;
  std::array<pollfd, 2> open{pollfd{out.read, POLLIN, 0}, pollfd{err.read, POLLIN, 0}};
  while (open[0].fd >= 0 || open[1].fd >= 0) {
    constexpr int kMilliseconds = 5;
    ::poll(open.data(), open.size(), kMilliseconds);
    for (pollfd& one : open) {
      if (one.revents && !drain(one.fd, one.fd == out.read ? outcome.out : outcome.err)) one.fd = -1;
    }
    if (outcome.err.empty()) firstWords = Clock::now();
    if (toSend && !outcome.err.empty() && since(firstWords) >= signalAfter) {
      ::kill(child, signal);
      start = Clock::now();
      toSend = false;
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  outcome.seconds = since(start);
  outcome.endedBeforeSignal = toSend;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  ::close(out.read);
  ::close(err.read);
  return outcome;
}

}  // namespace sdf
