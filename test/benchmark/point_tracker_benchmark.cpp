// SPDX-License-Identifier: BSD-3-Clause
// Time of the point front end for each image, in total and by stage, on one thread.
// Usage: point_tracker_benchmark CONFIG IMAGE_FOLDER [--benchmark_...]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "feature_tracker/contrast_equalizer.h"
#include "feature_tracker/detection/corner_detector.h"
#include "feature_tracker/following/optical_flow.h"
#include "feature_tracker/following/outlier_rejection.h"
#include "feature_tracker/point_tracker.h"
#include "test/benchmark/image_benchmark.h"
#include "tracking/images/image_mask.h"

namespace plm_vins {
namespace {

constexpr size_t kMaxImages = 400;
constexpr int64_t kFrame_ns = 50'000'000;

struct Input {
  Config config;
  std::vector<cv::Mat> images;

  const cv::Mat& Image(size_t i) const { return images[i % images.size()]; }
};

Input ReadInput(const std::string& config_file, const std::string& folder) {
  return {LoadConfig(config_file), ReadImages(folder, kMaxImages)};
}

cv::Mat Equalized(const cv::Mat& image) {
  ContrastEqualizer equalizer(image.size());
  cv::Mat equalized;
  equalizer.Apply(image, &equalized);
  return equalized;
}

void TrackWhole(benchmark::State& state, const Input& input) {
  PointTracker tracker(input.config.points,
                       CameraModel::Create(input.config.sensor.cameras[0].parameters),
                       ReadMask(input.config.points.fisheye_mask, input.Image(0).size()));
  size_t i = 0;
  for (auto _ : state) {
    if (i % input.images.size() == 0) tracker.Reset();
    benchmark::DoNotOptimize(
        tracker.Track({static_cast<int64_t>(i) * kFrame_ns, input.Image(i)}, std::nullopt));
    ++i;
  }
}

void Equalize(benchmark::State& state, const Input& input) {
  ContrastEqualizer equalizer(input.Image(0).size());
  cv::Mat equalized;
  size_t i = 0;
  for (auto _ : state) {
    equalizer.Apply(input.Image(i++), &equalized);
    benchmark::DoNotOptimize(equalized.data);
  }
}

void BuildPyramid(benchmark::State& state, const Input& input) {
  const OpticalFlow flow(input.config.points);
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(flow.BuildPyramid(input.Image(i++)));
}

void Detect(benchmark::State& state, const Input& input) {
  const CornerDetector detector(input.config.points, {});
  const cv::Mat image = Equalized(input.Image(0));
  const auto count = static_cast<int>(state.range(0));
  auto existing = detector.Detect(image, {}, input.config.points.max_cnt);
  existing.resize(existing.size() - std::min<size_t>(existing.size(), count));
  for (auto _ : state) benchmark::DoNotOptimize(detector.Detect(image, existing, count));
}

void Flow(benchmark::State& state, const Input& input) {
  const OpticalFlow flow(input.config.points);
  const cv::Mat image0 = Equalized(input.Image(0));
  const auto pyramid0 = flow.BuildPyramid(image0);
  const auto pyramid1 = flow.BuildPyramid(Equalized(input.Image(1)));
  const auto points =
      CornerDetector(input.config.points, {}).Detect(image0, {}, input.config.points.max_cnt);
  std::vector<FlowStart> starts;
  for (const cv::Point2f& point : points) starts.push_back({point, point});
  for (auto _ : state) benchmark::DoNotOptimize(flow.Track(pyramid0, pyramid1, starts));
}

void RejectOutliers(benchmark::State& state) {
  const bool has_gyro = state.range(0) != 0;
  const auto rotation =
      has_gyro ? std::make_optional(Eigen::Quaterniond::Identity()) : std::nullopt;
  cv::RNG random(1);
  std::vector<RayPair> pairs;
  for (int i = 0; i < 150; ++i) {
    const Eigen::Vector3d p_C0(random.uniform(-3., 3.), random.uniform(-2., 2.),
                               random.uniform(2., 9.));
    pairs.push_back({p_C0.normalized(), (p_C0 + Eigen::Vector3d(0.05, 0, 0)).normalized()});
  }
  for (auto _ : state) benchmark::DoNotOptimize(FindEpipolarInliers(pairs, rotation, 1.0 / 460));
}

void Register(const Input& input) {
  const auto add = [&input](const char* name, void (*run)(benchmark::State&, const Input&)) {
    return benchmark::RegisterBenchmark(
               name, [run, &input](benchmark::State& state) { run(state, input); })
        ->Unit(benchmark::kMicrosecond);
  };
  add("whole", TrackWhole)->Iterations(static_cast<int64_t>(input.images.size()));
  add("equalize", Equalize);
  add("pyramid", BuildPyramid);
  add("detect_missing", Detect)->Arg(10)->Arg(150);
  add("flow_150_points", Flow);
  benchmark::RegisterBenchmark("reject_outliers_gyro", RejectOutliers)
      ->Arg(1)
      ->Arg(0)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) {
  return plm_vins::RunImageBenchmark(argc, argv, "point_tracker_benchmark", plm_vins::ReadInput,
                                     plm_vins::Register);
}
