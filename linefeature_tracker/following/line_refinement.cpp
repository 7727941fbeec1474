// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_refinement.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <utility>

#include "common/geometry/robust_weight.h"
#include "common/statistics.h"
#include "linefeature_tracker/segments/line_profile.h"
#include "linefeature_tracker/segments/line_segment.h"
#include "tracking/images/image_mask.h"

namespace plm_vins {
namespace {

constexpr double kStep_px = 4;             // between samples along a line
constexpr double kMaxRefinedSamples = 32;  // longer lines have a larger step
constexpr double kMaxRoughSamples = 12;
constexpr int kMaxSearch_px = 5;       // search range to each side
constexpr int kFineSearch_px = 2;      // after the rough placement
constexpr int kExtension = 3;          // samples beyond each endpoint
constexpr int kMaxGap = 2;             // samples without an edge inside a line
constexpr double kMinSupport = 0.6;    // share of samples with an edge
constexpr double kMinGradient = 5;     // across a line [gray levels/px]
constexpr double kMaxResidual_px = 1;  // residual of a supporting sample
constexpr size_t kMinPoints = 5;
constexpr size_t kMinFinalPoints = 3;  // between the endpoints; two would be fitted by any line
constexpr std::array<double, 3> kRobustScales_px = {2.0, 1.0, 0.5};

// Returns the points at which an edge was found.
template <typename EdgePoint>
std::vector<EdgePoint> OnEdges(std::vector<EdgePoint> points) {
  const auto is_missing = [](const EdgePoint& point) { return !point.found; };
  points.erase(std::remove_if(points.begin(), points.end(), is_missing), points.end());
  return points;
}

// Weighted least squares fit of the offsets, starting at the median, with Geman-McClure weights of
// decreasing scale [px]. `points` must not be empty.
template <typename EdgePoint>
LineOffset FitOffset(const std::vector<EdgePoint>& points) {
  std::vector<double> offsets;
  offsets.reserve(points.size());
  for (const EdgePoint& point : points) {
    offsets.push_back(point.offset_px * point.sample.offset_per_pixel);
  }
  LineOffset fit{Median(std::move(offsets)), 0};
  for (const double scale_px : kRobustScales_px) {
    Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (const EdgePoint& point : points) {
      const double pixels = 1 / point.sample.offset_per_pixel;
      const double residual_px = point.offset_px - fit.At(point.sample.along) * pixels;
      const double weight = GemanMcClureWeight(residual_px, scale_px);
      const Eigen::Vector2d J(pixels, point.sample.along * pixels);
      H += weight * J * J.transpose();
      b += weight * J * point.offset_px;
    }
    const Eigen::Vector2d solution = H.inverse() * b;
    if (!solution.allFinite()) break;
    fit = {solution.x(), solution.y()};
  }
  return fit;
}

}  // namespace

LineRefinement::LineRefinement(const LineTrackerConfig& config,
                               std::shared_ptr<const CameraModel> camera, const cv::Mat& mask)
    : camera_(std::move(camera)),
      mask_(mask),
      min_length_px_(config.min_length *
                     std::min(camera_->parameters().width, camera_->parameters().height)) {}

std::optional<LineSegment> LineRefinement::Refine(const cv::Mat& image, const LineSegment& guess,
                                                  int search_px) const {
  const auto rough = PlaceRoughly(image, guess, search_px);
  return rough ? Place(image, *rough) : std::nullopt;
}

std::optional<LineSegment> LineRefinement::PlaceRoughly(const cv::Mat& image,
                                                        const LineSegment& guess,
                                                        int search_px) const {
  const std::vector<EdgePoint> edges = OnEdges(LocateEdges(
      image, guess, Step(guess, kMaxRoughSamples), 0, std::min(search_px, kMaxSearch_px)));
  if (edges.size() < kMinPoints) return std::nullopt;
  return Shifted(guess, FitOffset(edges));
}

std::optional<LineSegment> LineRefinement::Place(const cv::Mat& image,
                                                 const LineSegment& rough) const {
  const double step = Step(rough, kMaxRefinedSamples);
  std::vector<EdgePoint> points = LocateEdges(image, rough, step, kExtension, kFineSearch_px);
  const std::vector<EdgePoint> edges = OnEdges(points);
  if (edges.size() < kMinPoints) return std::nullopt;
  const LineOffset fit = FitOffset(edges);
  for (EdgePoint& point : points) {
    const double residual_px =
        point.offset_px - fit.At(point.sample.along) / point.sample.offset_per_pixel;
    point.found = point.found && std::abs(residual_px) <= kMaxResidual_px;
  }
  const auto part = SupportedPart(rough, step, points);
  if (!part) return std::nullopt;
  // Fits again without the points beyond the ends, which may belong to another edge.
  const double first = rough.Along(part->start);
  const double last = rough.Along(part->end);
  for (EdgePoint& point : points) {
    point.found = point.found && point.sample.along > first && point.sample.along < last;
  }
  const std::vector<EdgePoint> supporting = OnEdges(std::move(points));
  if (supporting.size() < kMinFinalPoints) return std::nullopt;
  const LineOffset final_fit = FitOffset(supporting);
  const Eigen::Vector2d normal = rough.Normal();
  const auto on_line = [&](const Eigen::Vector2d& xy) -> Eigen::Vector2d {
    return xy + final_fit.At(rough.Along(xy)) * normal;
  };
  return LineSegment{on_line(part->start), on_line(part->end)};
}

// Normalized distance of samples, such that the segment has at most `max_samples`.
double LineRefinement::Step(const LineSegment& segment, double max_samples) const {
  const auto segment_px = ProjectSegment(*camera_, segment);
  const double length_px =
      segment_px ? segment_px->Length() : segment.Length() * camera_->FocalLength();
  return segment.Length() / std::clamp(std::round(length_px / kStep_px), 1.0, max_samples);
}

// Locates the edge at every sample, from `extension` steps before the start to `extension` steps
// after the end.
std::vector<LineRefinement::EdgePoint> LineRefinement::LocateEdges(const cv::Mat& image,
                                                                   const LineSegment& segment,
                                                                   double step, int extension,
                                                                   int search_px) const {
  const int count = static_cast<int>(std::lround(segment.Length() / step));
  std::vector<EdgePoint> points;
  points.reserve(count + 2 * extension + 1);
  for (int i = -extension; i <= count + extension; ++i) {
    const auto sample = SampleSegment(*camera_, segment, i * step);
    EdgePoint point;
    point.sample.along = i * step;
    point.sample.offset_per_pixel = 1;
    if (sample) {
      point.sample = *sample;
      if (IsVisible(sample->pixel)) LocateEdge(image, search_px, &point);
    }
    points.push_back(point);
  }
  return points;
}

bool LineRefinement::IsVisible(const Eigen::Vector2d& pixel) const {
  return camera_->IsInImage(pixel, kLineBorder_px) &&
         MaskAllows(mask_, {cvRound(pixel.x()), cvRound(pixel.y())});
}

// Finds the steepest brightness increase across the line, with preference for positions near the
// sample, and refines it to the vertex of the parabola through its neighbors.
void LineRefinement::LocateEdge(const cv::Mat& image, int search_px, EdgePoint* point) const {
  const int radius = search_px + 2;
  const Eigen::Vector2f center = point->sample.pixel.cast<float>();
  const Eigen::Vector2f normal = point->sample.normal_px.cast<float>();
  static_assert(kMaxSearch_px + 2 <= kMaxProfileRadius);
  LineProfile profile;
  if (!ReadProfile(image, center, normal, radius, &profile)) return;
  const auto rise = [&](int j) {
    return 0.5F * (profile[j + radius + 1] - profile[j + radius - 1]);
  };
  float best = 0;
  for (int j = -search_px; j <= search_px; ++j) {
    const float center_rise = rise(j);
    const float closeness =
        1 - 0.5F * static_cast<float>(std::abs(j)) / static_cast<float>(search_px + 1);
    if (center_rise < kMinGradient || center_rise * closeness <= best) continue;
    const float before = rise(j - 1);
    const float after = rise(j + 1);
    if (center_rise < before || center_rise < after) continue;
    const float curvature = before - 2 * center_rise + after;
    const float vertex = curvature < 0 ? 0.5F * (before - after) / curvature : 0;
    best = center_rise * closeness;
    point->found = true;
    point->offset_px = j + vertex;
  }
}

// Returns the longest part of the line whose samples show an edge, with small gaps allowed.
std::optional<LineSegment> LineRefinement::SupportedPart(
    const LineSegment& line, double step, const std::vector<EdgePoint>& points) const {
  const int count = static_cast<int>(points.size());
  int best_first = 0, best_last = -1, best_support = 0;
  int first = -1, last = -1, support = 0;
  for (int i = 0; i < count; ++i) {
    if (!points[i].found) continue;
    if (first < 0 || i - last > kMaxGap + 1) {
      first = i;
      support = 0;
    }
    last = i;
    ++support;
    if (last - first > best_last - best_first) {
      best_first = first;
      best_last = last;
      best_support = support;
    }
  }
  const int samples = best_last - best_first + 1;
  if (samples < static_cast<int>(kMinPoints) || best_support < kMinSupport * samples)
    return std::nullopt;
  // A line of which only a small part is left counts as lost.
  const int expected = static_cast<int>(std::lround(line.Length() / step));
  if (best_support < kMinSupport * kMinSupport * expected) return std::nullopt;
  const double length_px =
      (points[best_last].sample.pixel - points[best_first].sample.pixel).norm();
  if (length_px < min_length_px_) return std::nullopt;
  const Eigen::Vector2d direction = line.Direction();
  return LineSegment{line.start + points[best_first].sample.along * direction,
                     line.start + points[best_last].sample.along * direction};
}

}  // namespace plm_vins
