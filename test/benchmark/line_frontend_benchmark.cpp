// SPDX-License-Identifier: BSD-3-Clause
// Compares the line front end with detection from scratch by LSD and matching by LBD descriptors,
// on one thread: time for each image, and quality as counters of the benchmarks named quality_*.
// Usage: line_frontend_benchmark CONFIG IMAGE_FOLDER [--benchmark_...]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <memory>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/line_descriptor.hpp>
#include <set>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "linefeature_tracker/detection/line_finder.h"
#include "linefeature_tracker/following/line_flow.h"
#include "linefeature_tracker/line_tracker.h"
#include "linefeature_tracker/segments/segment_sampler.h"
#include "test/benchmark/image_benchmark.h"
#include "test/linefeature_tracker/bar_scene.h"

namespace plm_vins {
namespace {

using cv::line_descriptor::BinaryDescriptor;
using cv::line_descriptor::KeyLine;

constexpr size_t kMaxImages = 300;

struct Input {
  std::shared_ptr<const CameraModel> camera;
  std::vector<cv::Mat> images;
};

Input ReadInput(const std::string& config_file, const std::string& folder) {
  return {CameraModel::Create(LoadConfig(config_file).sensor.cameras[0].parameters),
          ReadImages(folder, kMaxImages)};
}

// Common interface of both pipelines: tracks the lines (normalized) of consecutive images.
class FrontEnd {
 public:
  virtual ~FrontEnd() = default;
  virtual LineFrame Track(const ImageSample& image) = 0;
};

class OurFrontEnd : public FrontEnd {
 public:
  OurFrontEnd(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera)
      : tracker_(config, std::move(camera)) {}
  LineFrame Track(const ImageSample& image) override { return tracker_.Track(image, std::nullopt); }

 private:
  LineTracker tracker_;
};

// LSD with common settings (scale 0.5, sigma 0.6, quantization 2, angle 22.5 degrees, density 0.6,
// lines of at least an eighth of the short side) and LBD descriptors. Each line is matched with the
// nearby line of the previous image that has the smallest Hamming distance.
class LsdLbdFrontEnd : public FrontEnd {
 public:
  explicit LsdLbdFrontEnd(std::shared_ptr<const CameraModel> camera) : camera_(std::move(camera)) {}

  LineFrame Track(const ImageSample& image) override {
    std::vector<KeyLine> lines = Detect(image.gray);
    cv::Mat descriptors;
    if (!lines.empty()) descriptor_->compute(image.gray, lines, descriptors);
    std::vector<int64_t> ids(lines.size(), -1);
    MatchPrevious(lines, descriptors, &ids);
    LineFrame frame;
    frame.t_ns = image.t_ns;
    for (size_t i = 0; i < lines.size(); ++i) {
      if (ids[i] < 0) ids[i] = next_id_++;
      const LineSegment segment_px{{lines[i].startPointX, lines[i].startPointY},
                                   {lines[i].endPointX, lines[i].endPointY}};
      const auto segment = UnprojectSegment(*camera_, segment_px);
      if (segment) frame.lines.push_back({ids[i], segment->start, segment->end});
    }
    lines_ = std::move(lines);
    descriptors_ = descriptors;
    ids_ = std::move(ids);
    return frame;
  }

 private:
  static constexpr float kMaxHamming = 30;
  static constexpr double kMaxMotion_px = 60;
  static constexpr double kMaxAngle = 0.17;  // [rad]

  std::vector<KeyLine> Detect(const cv::Mat& image) {
    std::vector<cv::Vec4f> segments;
    lsd_->detect(image, segments);
    const double min_length_px = 0.125 * std::min(image.cols, image.rows);
    std::vector<KeyLine> lines;
    for (const cv::Vec4f& segment : segments) {
      const cv::Point2f start(segment[0], segment[1]), end(segment[2], segment[3]);
      if (cv::norm(end - start) < min_length_px) continue;
      if (!cv::Rect2f(0, 0, static_cast<float>(image.cols), static_cast<float>(image.rows))
               .contains(start))
        continue;
      lines.push_back(MakeKeyLine(start, end, static_cast<int>(lines.size())));
    }
    return lines;
  }

  static KeyLine MakeKeyLine(const cv::Point2f& start, const cv::Point2f& end, int index) {
    KeyLine line;
    line.startPointX = line.sPointInOctaveX = start.x;
    line.startPointY = line.sPointInOctaveY = start.y;
    line.endPointX = line.ePointInOctaveX = end.x;
    line.endPointY = line.ePointInOctaveY = end.y;
    line.angle = std::atan2(end.y - start.y, end.x - start.x);
    line.lineLength = static_cast<float>(cv::norm(end - start));
    line.numOfPixels =
        static_cast<int>(std::max(std::abs(end.x - start.x), std::abs(end.y - start.y))) + 1;
    line.octave = 0;
    line.class_id = index;
    line.pt = 0.5F * (start + end);
    return line;
  }

  void MatchPrevious(const std::vector<KeyLine>& lines, const cv::Mat& descriptors,
                     std::vector<int64_t>* ids) {
    if (descriptors.empty() || descriptors_.empty()) return;
    std::vector<cv::DMatch> matches;
    matcher_.match(descriptors, descriptors_, matches);
    std::sort(matches.begin(), matches.end());
    std::set<int> taken;
    for (const cv::DMatch& match : matches) {
      const KeyLine& now = lines[match.queryIdx];
      const KeyLine& before = lines_[match.trainIdx];
      const double angle = std::remainder(now.angle - before.angle, 2 * M_PI);
      if (match.distance > kMaxHamming || std::abs(angle) > kMaxAngle) continue;
      if (cv::norm(now.pt - before.pt) > kMaxMotion_px) continue;
      if (taken.insert(match.trainIdx).second) (*ids)[match.queryIdx] = ids_[match.trainIdx];
    }
  }

  std::shared_ptr<const CameraModel> camera_;
  cv::Ptr<cv::LineSegmentDetector> lsd_ =
      cv::createLineSegmentDetector(cv::LSD_REFINE_STD, 0.5, 0.6, 2.0, 22.5, 1.0, 0.6, 1024);
  cv::Ptr<BinaryDescriptor> descriptor_ = BinaryDescriptor::createBinaryDescriptor();
  cv::BFMatcher matcher_{cv::NORM_HAMMING};
  std::vector<KeyLine> lines_;
  cv::Mat descriptors_;
  std::vector<int64_t> ids_;
  int64_t next_id_ = 0;
};

using MakeFrontEnd = std::unique_ptr<FrontEnd> (*)(std::shared_ptr<const CameraModel>);

std::unique_ptr<FrontEnd> MakeOurs(std::shared_ptr<const CameraModel> camera) {
  return std::make_unique<OurFrontEnd>(LineTrackerConfig(), std::move(camera));
}

std::unique_ptr<FrontEnd> MakeLsdLbd(std::shared_ptr<const CameraModel> camera) {
  return std::make_unique<LsdLbdFrontEnd>(std::move(camera));
}

void RunWhole(benchmark::State& state, const Input& input, MakeFrontEnd make) {
  const auto front_end = make(input.camera);
  size_t i = 0;
  for (auto _ : state) {
    const ImageSample image{static_cast<int64_t>(i) * kFrame_ns,
                            input.images[i % input.images.size()]};
    benchmark::DoNotOptimize(front_end->Track(image));
    ++i;
  }
}

std::set<int64_t> Ids(const LineFrame& frame) {
  std::set<int64_t> ids;
  for (const LineObservation& line : frame.lines) ids.insert(line.id);
  return ids;
}

// Share of the lines that are still tracked `later` images later, over all images.
double Survival(const std::vector<LineFrame>& frames, size_t later) {
  double lines = 0, alive = 0;
  for (size_t i = 0; i + later < frames.size(); ++i) {
    const std::set<int64_t> ids = Ids(frames[i + later]);
    lines += static_cast<double>(frames[i].lines.size());
    for (const LineObservation& line : frames[i].lines)
      alive += static_cast<double>(ids.count(line.id));
  }
  return lines > 0 ? alive / lines : 0;
}

double MeanLengthInPixels(const std::vector<LineFrame>& frames, const CameraModel& camera) {
  double count = 0, sum = 0;
  for (const LineFrame& frame : frames) {
    for (const LineObservation& line : frame.lines) {
      const auto segment_px = ProjectSegment(camera, {line.start, line.end});
      if (!segment_px) continue;
      ++count;
      sum += segment_px->Length();
    }
  }
  return count > 0 ? sum / count : 0;
}

double MeanTrackLength(const std::vector<LineFrame>& frames) {
  double observations = 0;
  std::set<int64_t> ids;
  for (const LineFrame& frame : frames) {
    observations += static_cast<double>(frame.lines.size());
    for (const LineObservation& line : frame.lines) ids.insert(line.id);
  }
  return ids.empty() ? 0 : observations / static_cast<double>(ids.size());
}

void JudgeOnImages(benchmark::State& state, const Input& input, MakeFrontEnd make) {
  std::vector<LineFrame> frames;
  for (auto _ : state) {
    frames.clear();
    const auto front_end = make(input.camera);
    for (size_t i = 0; i < input.images.size(); ++i)
      frames.push_back(front_end->Track({static_cast<int64_t>(i) * kFrame_ns, input.images[i]}));
  }
  double lines = 0;
  for (const LineFrame& frame : frames) lines += static_cast<double>(frame.lines.size());
  state.counters["lines"] = lines / static_cast<double>(frames.size());
  state.counters["length_px"] = MeanLengthInPixels(frames, *input.camera);
  state.counters["track_images"] = MeanTrackLength(frames);
  state.counters["alive_5"] = Survival(frames, 5);
  state.counters["alive_10"] = Survival(frames, 10);
}

// Homography of simulated image i: a flight with rotation past a plane of bars.
Eigen::Matrix3d SimulatedMotion(int i) {
  Eigen::Matrix3d H = Eigen::AngleAxisd(0.006 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  H(0, 2) += 0.004 * i;
  H(1, 2) -= 0.003 * i;
  H(2, 2) += 0.004 * i;
  return H;
}

// Index of the edge on which the line lies; -1 if there is none.
int EdgeOf(const std::vector<LineSegment>& edges, const LineSegment& line, double focal) {
  constexpr double kMaxError_px = 3;
  int best = -1;
  double best_error = kMaxError_px;
  for (size_t i = 0; i < edges.size(); ++i) {
    if (Relate(edges[i], line).overlap < 0.5) continue;
    const double error = NormalErrorInPixels(edges[i], line, focal);
    if (error >= best_error) continue;
    best = static_cast<int>(i);
    best_error = error;
  }
  return best;
}

void JudgeOnSimulation(benchmark::State& state, MakeFrontEnd make) {
  constexpr int kImages = 20;
  constexpr double kNoise = 3;  // gray levels
  const LineScene scene = BarScene(DistortedParameters());
  const double focal = scene.camera()->FocalLength();
  std::vector<cv::Mat> images;
  images.reserve(kImages);
  for (int i = 0; i < kImages; ++i) images.push_back(scene.View(SimulatedMotion(i), kNoise));
  std::vector<double> errors;
  int switched = 0;
  for (auto _ : state) {
    errors.clear();
    switched = 0;
    const auto front_end = make(scene.camera());
    std::map<int64_t, int> edge_of_id;
    for (int i = 0; i < kImages; ++i) {
      const LineFrame frame = front_end->Track({i * kFrame_ns, images[i]});
      const auto edges = scene.Edges(SimulatedMotion(i));
      for (const LineObservation& line : frame.lines) {
        const int edge = EdgeOf(edges, {line.start, line.end}, focal);
        if (edge < 0) continue;
        errors.push_back(NormalErrorInPixels(edges[edge], {line.start, line.end}, focal));
        if (edge_of_id.emplace(line.id, edge).first->second != edge) ++switched;
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  state.counters["observations"] = static_cast<double>(errors.size());
  state.counters["error_median_px"] = errors.empty() ? -1 : errors[errors.size() / 2];
  state.counters["error_p95_px"] = errors.empty() ? -1 : errors[errors.size() * 95 / 100];
  state.counters["switched"] = switched;
}

void Detect(benchmark::State& state, const Input& input, LineDetectorType type) {
  LineTrackerConfig config;
  config.line_detector = type;
  LineFinder finder(config, input.camera);
  const auto pyramid = LineFlow::BuildPyramid(input.images.front());
  int fragments = 0;
  size_t lines = 0;
  for (auto _ : state) lines = finder.Find(pyramid, &fragments).size();
  state.counters["fragments"] = fragments;
  state.counters["lines"] = static_cast<double>(lines);
}

void BuildPyramid(benchmark::State& state, const Input& input) {
  for (auto _ : state) benchmark::DoNotOptimize(LineFlow::BuildPyramid(input.images.front()));
}

template <typename Function>
benchmark::internal::Benchmark* Add(const std::string& name, Function run) {
  return benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMicrosecond);
}

void Register(const Input& input) {
  const std::vector<std::pair<std::string, MakeFrontEnd>> front_ends = {{"ours", MakeOurs},
                                                                        {"lsd_lbd", MakeLsdLbd}};
  const auto images = static_cast<int64_t>(input.images.size());
  for (const auto& [name, make] : front_ends) {
    Add("whole_" + name, [&input, make = make](auto& state) {
      RunWhole(state, input, make);
    })->Iterations(images);
  }
  for (const auto& [name, make] : front_ends) {
    Add("quality_" + name, [&input, make = make](auto& state) {
      JudgeOnImages(state, input, make);
    })->Iterations(1);
    Add("quality_simulated_" + name, [make = make](auto& state) {
      JudgeOnSimulation(state, make);
    })->Iterations(1);
  }
  Add("pyramid", [&input](auto& state) { BuildPyramid(state, input); });
  const std::vector<std::pair<std::string, LineDetectorType>> detectors = {
      {"fld", LineDetectorType::kFld},
      {"lsd", LineDetectorType::kLsd},
      {"edlines", LineDetectorType::kEdLines}};
  for (const auto& [name, type] : detectors)
    Add("detect_" + name, [&input, type = type](auto& state) { Detect(state, input, type); });
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) {
  return plm_vins::RunImageBenchmark(argc, argv, "line_frontend_benchmark", plm_vins::ReadInput,
                                     plm_vins::Register);
}
