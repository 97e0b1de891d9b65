// What a mesh costs as its tolerance falls: triangles, time and peak memory of sdf2gltf on measuring shape
// S2, each run a process of its own. build/release/bin/growth [TOLERANCE]...
#include <cstdio>
#include <string>
#include <vector>

#include "exporter.h"
#include "figures.h"

int main(int argc, char** argv) {
  using namespace sdf::bench;
  constexpr int kLongest = 600;  // seconds
  std::vector<std::string> tolerances(argv + 1, argv + argc);
  if (tolerances.empty()) tolerances = {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6"};

  std::printf("%s\n", machine().c_str());
  std::printf("%-10s %10s %10s %10s %10s   %s\n", "tolerance", "triangles", "max error", "time", "memory",
              "times the triangles, time, memory of the last");
  std::optional<Exported> last;
  for (const std::string& tolerance : tolerances) {
    int status = 0;
    const auto done =
        exported({SDF_SAMPLES "/bench/s2_csg.lua", "--tolerance", tolerance}, kLongest, &status);
    if (!done && status == kTimedOut)
      std::printf("%-10s not done after %d s\n", tolerance.c_str(), kLongest);
    else if (!done)
      std::printf("%-10s refused, exit status %d\n", tolerance.c_str(), status);
    else
      std::printf("%-10s %10.0f %10.2e %8.2f s %7.0f MB", tolerance.c_str(), done->triangles,
                  done->maxDistance, done->seconds, done->peakMegabytes);
    if (done && last)
      std::printf("   %.1f, %.1f, %.1f", done->triangles / last->triangles, done->seconds / last->seconds,
                  done->peakMegabytes / last->peakMegabytes);
    if (done) std::printf("\n");
    std::fflush(stdout);
    last = done;
  }
}
