// Ctrl-C at any time: gone within a second, and nothing left.
#include <csignal>

#include "sdf2gltf.h"

namespace sdf {
namespace interrupt_test {

constexpr int kInterrupted = 130;
constexpr double kASecond = 1.0;

class Interrupt : public Sdf2gltf {
 protected:
  /// Sends `signal` after each of several times and checks the end. The work must take longer than the last
  /// of them.
  void expectQuickEnd(const std::vector<std::string>& arguments, int signal) {
    for (const double after : {0.0, 0.3, 1.5}) {
      Command command = Interrupt::command(arguments);
      command.terminal = true;  // its progress line tells when the program has begun
      command.signal = signal;
      command.signalAfter = after;
      const Outcome outcome = command.run();
      ASSERT_FALSE(outcome.endedBeforeSignal) << outcome.err;
      EXPECT_LT(outcome.seconds, kASecond) << "after " << after << " s";
      EXPECT_EQ(outcome.status, kInterrupted) << outcome.err;
      EXPECT_NE(outcome.err.find("sdf2gltf: interrupted"), std::string::npos) << outcome.err;
      EXPECT_EQ(written(), std::vector<std::string>{});
    }
  }
};

constexpr const char* kLarge = "return gyroid(0.5, 0.1) & sphere(10)";

TEST_F(Interrupt, EndsMeshing) {
  const std::vector<std::string> arguments{scene(kLarge), "-o",           out("a.glb"), "--report",
                                           out("r.json"), "--voxel-size", "0.02"};
  expectQuickEnd(arguments, SIGINT);
  expectQuickEnd(arguments, SIGTERM);
}

TEST_F(Interrupt, EndsAnAnimation) {
  const std::string growing = scene("return sphere(1 + time)");
  expectQuickEnd({growing, "-o", out("a.glb"), "--animate", "--frames", "10000", "--voxel-size", "0.02"},
                 SIGINT);
}

TEST_F(Interrupt, EndsASceneThatTakesLong) {
  // Each round is few instructions and much work, so that the bound on instructions is far.
  expectQuickEnd({scene("local s = sphere(1) while true do s = s | sphere(1) end"), "-o", out("a.glb")},
                 SIGINT);
}

}  // namespace interrupt_test
}  // namespace sdf
