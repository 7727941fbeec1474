// SPDX-License-Identifier: BSD-3-Clause
// A long simulated flight through the estimation stage, with points and lines, whose memory and
// time must not grow. plm_soak [SECONDS of flight, at least 60, default 3600] exits with code 1 if
// memory or time per image has grown from the second tenth of the flight to the last.
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <vector>

#include "test/fuzz/stage_flight.h"

namespace plm_vins::fuzz {
namespace {

constexpr size_t kParts = 10;
constexpr double kShortest = 60;  // [s]
constexpr double kMaxGrowth_MB = 5;
constexpr double kMaxSlowdown = 1.3;  // other programs share the caches

struct Part {
  int64_t images = 0, poses = 0, restarts = 0;
  double milliseconds = 0;  // CPU time per image
  double memory_MB = 0;     // at its end
};

double MegabytesInUse() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return 1e-6 * resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

std::vector<Part> Soak(double seconds) {
  const simulator::FeatureDataset flight = SimulateFastFlight(seconds);
  const size_t images_per_part = flight.points.size() / kParts;
  std::vector<Part> parts(1);
  std::clock_t begin = std::clock();
  Fly(flight, [&](const EstimatorOutput& output) {
    Part& part = parts.back();
    ++part.images;
    part.poses += output.has_pose;
    part.restarts += output.restarted;
    if (part.images < static_cast<int64_t>(images_per_part)) return;
    const std::clock_t end = std::clock();
    part.milliseconds = 1e3 * static_cast<double>(end - begin) / CLOCKS_PER_SEC / part.images;
    part.memory_MB = MegabytesInUse();
    std::printf("%" PRId64 " images, %" PRId64 " poses, %" PRId64 " restarts, %.2f ms, %.1f MB\n",
                part.images, part.poses, part.restarts, part.milliseconds, part.memory_MB);
    std::fflush(stdout);  // for watching, also in a file
    begin = end;
    parts.emplace_back();
  });
  parts.pop_back();
  return parts;
}

bool Grows(const std::vector<Part>& parts) {
  const Part &second = parts.at(1), &last = parts.back();
  return last.memory_MB > second.memory_MB + kMaxGrowth_MB ||
         last.milliseconds > kMaxSlowdown * second.milliseconds;
}

}  // namespace
}  // namespace plm_vins::fuzz

int main(int argc, char** argv) {
  using namespace plm_vins::fuzz;
  const double seconds = argc > 1 ? std::atof(argv[1]) : 3600;
  const bool grows = Grows(Soak(std::max(kShortest, seconds)));
  if (grows) std::fprintf(stderr, "plm_soak: grows\n");
  return grows ? 1 : 0;
}
