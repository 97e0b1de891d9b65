#include "viewer/app/display.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace sdf::viewer {
namespace {

/// The server, and the folder with the file that holds its screen's memory.
class Server {
 public:
  Server() {
    std::filesystem::create_directories(folder_);
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    if (::fork() == 0) run(ends);
    ::close(ends[1]);
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) display_ += c;
    ::close(ends[0]);
  }
  ~Server() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  /// A number, or "" if there is no Xvfb.
  const std::string& display() const { return display_; }
  std::filesystem::path screen() const { return folder_ / "Xvfb_screen0"; }

 private:
  [[noreturn]] void run(const int (&ends)[2]) const {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::close(ends[0]);
    ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
    ::execlp("Xvfb", "Xvfb", "-displayfd", std::to_string(ends[1]).c_str(), "-screen", "0", "1024x768x24",
             "-nolisten", "tcp", "-noreset", "-fbdir", folder_.c_str(), nullptr);
    ::_exit(1);
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("sdf_display_" + std::to_string(::getpid()));
  std::string display_;
};

const Server& server() {
  static const Server one;
  return one;
}

}  // namespace

bool ensureDisplay() {
  if (server().display().empty()) return false;
  ::setenv("DISPLAY", (":" + server().display()).c_str(), 1);
  return true;
}

// The file is in the format of xwd: a header of big-endian words, colours of 12 bytes, then rows of BGRX.
Picture screenPicture() {
  std::ifstream in(server().screen(), std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(in), {}};
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(file.at(i)); };
  const auto word = [&](std::size_t i) {
    return std::size_t{byte(4 * i)} << 24 | std::size_t{byte(4 * i + 1)} << 16 |
           std::size_t{byte(4 * i + 2)} << 8 | byte(4 * i + 3);
  };
  const std::size_t width = word(4), height = word(5), rowBytes = word(12), begin = word(0) + 12 * word(19);
  constexpr std::size_t kPixelBytes = 4;
  if (word(11) != 8 * kPixelBytes) throw std::runtime_error("the screen has other pixels than expected");
  Picture picture{static_cast<int>(width), static_cast<int>(height), 3, {}};
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      for (const std::size_t channel : {2, 1, 0})
        picture.bytes.push_back(byte(begin + y * rowBytes + x * kPixelBytes + channel));
  return picture;
}

}  // namespace sdf::viewer
