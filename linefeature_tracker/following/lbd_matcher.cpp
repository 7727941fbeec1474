// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/lbd_matcher.h"

#include <limits>

namespace plm_vins {
namespace {

// Penalty for the distance from the prediction, added to the Hamming distance: repetitive structure
// has equal descriptors everywhere.
constexpr double kBitsPerPixel = 2;

using cv::line_descriptor::BinaryDescriptor;
using cv::line_descriptor::KeyLine;

KeyLine ToKeyLine(const LineSegment& segment_px, int index) {
  KeyLine line;
  line.startPointX = line.sPointInOctaveX = static_cast<float>(segment_px.start.x());
  line.startPointY = line.sPointInOctaveY = static_cast<float>(segment_px.start.y());
  line.endPointX = line.ePointInOctaveX = static_cast<float>(segment_px.end.x());
  line.endPointY = line.ePointInOctaveY = static_cast<float>(segment_px.end.y());
  const Eigen::Vector2d difference = segment_px.end - segment_px.start;
  line.angle = static_cast<float>(std::atan2(difference.y(), difference.x()));
  line.lineLength = static_cast<float>(segment_px.Length());
  line.numOfPixels =
      static_cast<int>(std::max(std::abs(difference.x()), std::abs(difference.y()))) + 1;
  line.octave = 0;
  line.class_id = index;
  const Eigen::Vector2d middle = segment_px.Midpoint();
  line.pt = {static_cast<float>(middle.x()), static_cast<float>(middle.y())};
  line.size = line.lineLength;
  line.response = line.lineLength;
  return line;
}

}  // namespace

LbdMatcher::LbdMatcher(const LineTrackerConfig& config, double focal_length)
    : gate_(config, focal_length),
      focal_length_(focal_length),
      max_distance_(config.max_descriptor_distance) {
  BinaryDescriptor::Params parameters;
  parameters.numOfOctave_ = 1;
  descriptor_ = BinaryDescriptor::createBinaryDescriptor(parameters);
}

cv::Mat LbdMatcher::Describe(const cv::Mat& image,
                             const std::vector<LineSegment>& segments_px) const {
  if (segments_px.empty()) return {};
  std::vector<KeyLine> lines;
  for (const LineSegment& segment : segments_px)
    lines.push_back(ToKeyLine(segment, static_cast<int>(lines.size())));
  cv::Mat descriptors;
  descriptor_->compute(image, lines, descriptors);
  return descriptors;
}

std::vector<int> LbdMatcher::Match(const std::vector<Line>& older,
                                   const std::vector<Line>& newer) const {
  struct Best {
    int index = -1;
    double cost = std::numeric_limits<double>::max();
  };
  std::vector<Best> best_newer(older.size()), best_older(newer.size());
  for (size_t i = 0; i < older.size(); ++i) {
    for (size_t j = 0; j < newer.size(); ++j) {
      if (!gate_.Accepts(older[i].segment, newer[j].segment)) continue;
      const double bits = cv::norm(older[i].descriptor, newer[j].descriptor, cv::NORM_HAMMING);
      if (bits > max_distance_) continue;
      const double distance_px =
          focal_length_ * Relate(older[i].segment, newer[j].segment).distance;
      const double cost = bits + kBitsPerPixel * distance_px;
      if (cost < best_newer[i].cost) best_newer[i] = {static_cast<int>(j), cost};
      if (cost < best_older[j].cost) best_older[j] = {static_cast<int>(i), cost};
    }
  }
  std::vector<int> matches(older.size(), -1);
  for (size_t i = 0; i < older.size(); ++i) {
    const int j = best_newer[i].index;
    if (j >= 0 && best_older[j].index == static_cast<int>(i)) matches[i] = j;
  }
  return matches;
}

}  // namespace plm_vins
