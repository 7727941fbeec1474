// SPDX-License-Identifier: BSD-3-Clause
// Compares the time of the window optimization for each image, covariance included, by our solver
// and by Ceres. An estimator with each of them processes the same features of a recording. Each
// iteration of the benchmark is one window.
// Usage: solver_benchmark CONFIG ASL_FOLDER [--benchmark_...]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"
#include "common/process_setup.h"
#include "common/statistics.h"
#include "offline/pipeline/feature_trackers.h"
#include "offline/recordings/asl_recording.h"
#include "vins_estimator/estimator.h"
#include "vins_estimator/input/measurement_sync.h"

namespace plm_vins {
namespace {

void Take(TrackedFeatures frame, MeasurementSync* sync) {
  if (!frame.points.publish) return;
  sync->AddPoints(std::move(frame.points.features));
  if (frame.lines) sync->AddLines(std::move(frame.lines->features));
}

// Returns the estimator's input for the whole recording.
std::vector<FrameMeasurement> Measure(const Config& config, Recording* recording) {
  FeatureTrackers trackers(config);
  MeasurementSync::Options options;
  options.td = config.sensor.td;
  options.expect_lines = config.use_lines;
  MeasurementSync sync(options);
  std::vector<FrameMeasurement> measurements;
  while (const auto event = recording->Next()) {
    if (event->kind == RecordingEvent::Kind::kImu) {
      trackers.AddImu(event->imu);
      sync.AddImu(event->imu);
    } else if (const auto image = recording->LoadImage()) {
      trackers.AddImage(0, {event->t_ns, *image});
    }
    while (auto frame = trackers.Pop()) Take(std::move(*frame), &sync);
    while (auto measurement = sync.Pop()) measurements.push_back(std::move(*measurement));
  }
  while (auto frame = trackers.Flush()) Take(std::move(*frame), &sync);
  while (auto measurement = sync.Flush()) measurements.push_back(std::move(*measurement));
  return measurements;
}

void Optimize(benchmark::State& state, Config config, SolverType solver,
              const std::vector<FrameMeasurement>& measurements) {
  config.estimator.solver = solver;
  Estimator estimator(config);
  auto next = measurements.begin();
  std::vector<double> times_ms;
  double landmarks = 0;
  for (auto _ : state) {
    EstimatorOutput output;
    while (!output.has_pose && next != measurements.end()) output = estimator.Process(*next++);
    times_ms.push_back(output.timings.optimization);
    landmarks += output.counts.points_in_window + output.counts.lines_in_window;
    state.SetIterationTime(1e-3 * output.timings.optimization);
  }
  state.counters["median_ms"] = Median(times_ms);
  state.counters["landmarks"] = landmarks / static_cast<double>(times_ms.size());
}

// Number of images for which the estimator has a pose.
int64_t CountWindows(const Config& config, const std::vector<FrameMeasurement>& measurements) {
  Estimator estimator(config);
  return std::count_if(measurements.begin(), measurements.end(),
                       [&](const FrameMeasurement& m) { return estimator.Process(m).has_pose; });
}

void Run(const std::string& config_file, const std::string& folder) {
  const Config config = LoadConfig(config_file);
  const std::vector<FrameMeasurement> measurements = Measure(config, OpenAslFolder(folder).get());
  const int64_t windows = CountWindows(config, measurements);
  if (windows == 0) throw std::invalid_argument("no pose in " + folder);
  for (const auto& [name, solver] :
       {std::pair("schur", SolverType::kSchur), std::pair("ceres", SolverType::kCeres)}) {
    benchmark::RegisterBenchmark(name,
                                 [&, solver = solver](benchmark::State& state) {
                                   Optimize(state, config, solver, measurements);
                                 })
        ->Iterations(windows)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) {
  plm_vins::SetUpProcess();
  benchmark::Initialize(&argc, argv);
  if (argc != 3) {
    std::cerr << "usage: solver_benchmark CONFIG ASL_FOLDER [--benchmark_...]\n";
    return 1;
  }
  try {
    plm_vins::Run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
