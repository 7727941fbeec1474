// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_flow.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "common/geometry/symmetric_system.h"
#include "linefeature_tracker/segments/line_profile.h"
#include "linefeature_tracker/segments/line_segment.h"
#include "linefeature_tracker/segments/segment_sampler.h"

namespace plm_vins {
namespace {

constexpr int kTopLevel = 3;
constexpr int kBottomLevel = 1;
constexpr int kRadius = 5;  // half the length of a profile [px of its level]
constexpr int kProfileSize = 2 * kRadius + 1;
static_assert(kRadius + 1 <= kMaxProfileRadius);
constexpr double kSpacing_px = 10;  // between profiles along the line
constexpr int kMinProfiles = 5;
constexpr int kMaxProfiles = 12;
constexpr int kMaxIterations = 8;
constexpr double kConverged_px = 0.1;  // [px of a level]; refinement follows
constexpr double kMinTurnLength = 10;  // shorter lines are not rotated [px of a level]

// Corresponding samples of the line in both images.
struct SamplePair {
  SegmentSample previous;
  SegmentSample current;
};

// Brightness profile across the line in the previous image, with its derivative.
struct Template {
  const SegmentSample* current = nullptr;
  LineProfile value = LineProfile::Zero();
  LineProfile slope = LineProfile::Zero();
  float slope_squares = 0;
  float slope_sum = 0;
};

// Running sums for the correlation of profiles.
struct CorrelationSums {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  double Correlation() const {
    const double variance_a = aa - a * a / n;
    const double variance_b = bb - b * b / n;
    const double covariance = ab - a * b / n;
    return variance_a > 0 && variance_b > 0 ? covariance / std::sqrt(variance_a * variance_b) : 0;
  }
};

double OffsetInPixels(const LineOffset& offset, const SegmentSample& sample) {
  return offset.At(sample.along) / sample.offset_per_pixel;
}

// Aligns the line at one pyramid level.
class LevelAlignment {
 public:
  LevelAlignment(const cv::Mat& previous, const cv::Mat& current,
                 const std::vector<SamplePair>& samples, int level)
      : current_(current), scale_(1.0 / (1 << level)) {
    templates_.reserve(samples.size());
    for (const SamplePair& pair : samples) AddTemplate(previous, pair);
  }

  bool HasEnough() const { return templates_.size() >= kMinProfiles; }

  // Updates the offset; returns false if too little of the line is visible.
  bool Align(double length_px, LineOffset* offset) const {
    const bool may_turn = length_px * scale_ >= kMinTurnLength;
    for (int i = 0; i < kMaxIterations; ++i) {
      const auto step = Step(may_turn, *offset);
      if (!step) return false;
      offset->at_start += step->at_start;
      offset->slope += step->slope;
      const SegmentSample& sample = *templates_.front().current;
      if (std::abs(OffsetInPixels(*step, sample)) * scale_ < kConverged_px) break;
    }
    return true;
  }

  double Correlation(const LineOffset& offset) const {
    CorrelationSums sums;
    LineProfile profile;
    for (const Template& reference : templates_) {
      if (!ReadCurrent(reference, offset, &profile)) continue;
      for (int j = 0; j < kProfileSize; ++j) {
        const double a = reference.value[j];
        const double b = profile[j];
        sums.n += 1, sums.a += a, sums.b += b;
        sums.aa += a * a, sums.bb += b * b, sums.ab += a * b;
      }
    }
    return sums.n > 0 ? sums.Correlation() : 0;
  }

 private:
  void AddTemplate(const cv::Mat& previous, const SamplePair& pair) {
    LineProfile wide;
    const Eigen::Vector2f center = (scale_ * pair.previous.pixel).cast<float>();
    if (!ReadProfile(previous, center, pair.previous.normal_px.cast<float>(), kRadius + 1, &wide))
      return;
    Template reference;
    reference.current = &pair.current;
    reference.value.head<kProfileSize>() = wide.segment<kProfileSize>(1);
    reference.slope.head<kProfileSize>() =
        0.5F * (wide.segment<kProfileSize>(2) - wide.head<kProfileSize>());
    reference.slope_squares = reference.slope.square().sum();
    reference.slope_sum = reference.slope.sum();
    templates_.push_back(reference);
  }

  bool ReadCurrent(const Template& reference, const LineOffset& offset,
                   LineProfile* profile) const {
    const SegmentSample& sample = *reference.current;
    const Eigen::Vector2d pixel = sample.pixel + OffsetInPixels(offset, sample) * sample.normal_px;
    return ReadProfile(current_, (scale_ * pixel).cast<float>(), sample.normal_px.cast<float>(),
                       kRadius, profile);
  }

  // Computes one Gauss-Newton step of the inverse compositional kind: the template is warped
  // instead of the image, so its derivatives are computed once. The third variable is the
  // brightness change.
  std::optional<LineOffset> Step(bool may_turn, const LineOffset& offset) const {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    int used = 0;
    LineProfile profile;
    for (const Template& reference : templates_) {
      if (!ReadCurrent(reference, offset, &profile)) continue;
      ++used;
      const LineProfile error = reference.value - profile;
      const SegmentSample& sample = *reference.current;
      const double pixels = scale_ / sample.offset_per_pixel;  // pixels of the level, per offset
      const Eigen::Vector2d d_pixels(pixels, pixels * sample.along);
      H.topLeftCorner<2, 2>() +=
          static_cast<double>(reference.slope_squares) * d_pixels * d_pixels.transpose();
      H.topRightCorner<2, 1>() += static_cast<double>(reference.slope_sum) * d_pixels;
      H(2, 2) += kProfileSize;
      b.head<2>() += static_cast<double>((error * reference.slope).sum()) * d_pixels;
      b(2) += error.sum();
    }
    if (used < kMinProfiles) return std::nullopt;
    H.bottomLeftCorner<1, 2>() = H.topRightCorner<2, 1>().transpose();
    if (!may_turn) H(1, 1) *= 1e6;
    const Eigen::Vector3d solution = SolveSymmetric(H, b);
    if (!solution.allFinite()) return std::nullopt;
    return LineOffset{solution.x(), solution.y()};
  }

  const cv::Mat& current_;
  double scale_;  // pixels of the level per pixel of the image
  std::vector<Template> templates_;
};

std::vector<SamplePair> SampleBoth(const CameraModel& camera, const LineSegment& segment,
                                   const LineSegment& predicted, double length_px) {
  const int count =
      std::clamp(static_cast<int>(length_px / kSpacing_px), kMinProfiles + 1, kMaxProfiles);
  std::vector<SamplePair> samples;
  samples.reserve(count);
  for (int k = 0; k < count; ++k) {
    const double share = (k + 0.5) / count;
    const auto previous = SampleSegment(camera, segment, share * segment.Length());
    const auto current = SampleSegment(camera, predicted, share * predicted.Length());
    if (previous && current) samples.push_back({*previous, *current});
  }
  return samples;
}

}  // namespace

LineFlow::Pyramid LineFlow::BuildPyramid(const cv::Mat& image) {
  Pyramid pyramid = {image};
  for (int level = 1; level <= kTopLevel; ++level) {
    cv::Mat half;
    cv::pyrDown(pyramid.back(), half);
    pyramid.push_back(half);
  }
  return pyramid;
}

std::optional<LineFlowResult> LineFlow::Track(const Pyramid& previous, const Pyramid& current,
                                              const LineSegment& segment,
                                              const LineSegment& predicted) const {
  const auto segment_px = ProjectSegment(*camera_, segment);
  if (!segment_px) return std::nullopt;
  const double length_px = segment_px->Length();
  const auto samples = SampleBoth(*camera_, segment, predicted, length_px);
  LineOffset offset;
  double correlation = 0;
  for (int level = kTopLevel; level >= kBottomLevel; --level) {
    const LevelAlignment alignment(previous[level], current[level], samples, level);
    const bool is_aligned = alignment.HasEnough() && alignment.Align(length_px, &offset);
    if (level > kBottomLevel) continue;  // near the border, coarse levels may fail
    if (!is_aligned) return std::nullopt;
    correlation = alignment.Correlation(offset);
  }
  return LineFlowResult{Shifted(predicted, offset), correlation};
}

}  // namespace plm_vins
