// SPDX-License-Identifier: BSD-3-Clause
// Time of every stage for each image of a recording, all in one thread: mean, median, 95th and 99th
// percentile, and each stage's share. It ends with the CPU time of the whole run, including
// decoding.
// Usage: stage_benchmark CONFIG ASL_FOLDER [PAUSE]
// PAUSE: time to wait after each image [ms]; it lets the caches go cold, as between live images.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/config/config.h"
#include "common/process_setup.h"
#include "offline/pipeline/odometry_pipeline.h"
#include "offline/recordings/asl_recording.h"
#include "offline/results/frame_columns.h"
#include "vins_estimator/output/series_summary.h"

namespace plm_vins {
namespace {

double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

using Timings = std::vector<Column<double>>;

// Returns the times of one stage in all frames.
std::vector<double> TimesOf(const std::vector<Timings>& frames, size_t stage) {
  std::vector<double> times;
  for (const Timings& frame : frames) times.push_back(frame[stage].value);
  return times;
}

void Print(const std::vector<Timings>& frames) {
  const Timings& stages = frames.front();
  const double total = Summarize(TimesOf(frames, stages.size() - 1)).mean;
  std::printf("%-16s %8s %8s %8s %8s %7s\n", "stage [ms]", "mean", "p50", "p95", "p99", "share");
  for (size_t stage = 0; stage < stages.size(); ++stage) {
    const SeriesSummary summary = Summarize(TimesOf(frames, stage));
    std::printf("%-16s %8.2f %8.2f %8.2f %8.2f %6.0f%%\n", stages[stage].name, summary.mean,
                summary.median, summary.p95, summary.p99, 100 * summary.mean / total);
  }
}

void Run(const std::string& config_file, const std::string& folder,
         std::chrono::milliseconds pause) {
  OdometryPipeline pipeline(LoadConfig(config_file));
  std::vector<Timings> frames;
  const double start = ProcessorSeconds();
  pipeline.Run(OpenAslFolder(folder).get(), RecordingInterval(), 1,
               [&](const PipelineFrame& frame) {
                 frames.push_back(ColumnsOf(frame).timings);
                 std::this_thread::sleep_for(pause);
               });
  if (frames.empty()) throw std::invalid_argument("no frame in " + folder);
  Print(frames);
  std::printf("processor: %.2f ms per image\n",
              1e3 * (ProcessorSeconds() - start) / static_cast<double>(pipeline.images()));
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: stage_benchmark CONFIG ASL_FOLDER [PAUSE]\n");
    return 1;
  }
  plm_vins::SetUpProcess();
  try {
    const int pause = argc == 4 ? std::stoi(argv[3]) : 0;
    plm_vins::Run(argv[1], argv[2], std::chrono::milliseconds(pause));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
