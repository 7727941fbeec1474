// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/line_witnesses.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace plm_vins {
namespace {

constexpr double kMinLineDepth = 0.1;  // [m]

// Image of a line segment (normalized).
struct Stretch {
  Eigen::Vector2d start;
  Eigen::Vector2d direction;  // unit
  double length;

  double Across(const Eigen::Vector2d& xy) const {
    const Eigen::Vector2d offset = xy - start;
    return std::abs(direction.x() * offset.y() - direction.y() * offset.x());
  }
  double Along(const Eigen::Vector2d& xy) const { return direction.dot(xy - start); }
};

std::optional<Stretch> MakeStretch(const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  const double length = (end - start).norm();
  if (length < 1e-6) return std::nullopt;
  return Stretch{start, (end - start) / length, length};
}

// Returns nullopt if the line is not in view: both ends must be in front of the camera and the
// midpoint inside the image.
std::optional<Stretch> Project(const CameraModel& camera, const Rigid3d& T_C_O,
                               const SpaceSegment& line) {
  const Eigen::Vector3d start_C = T_C_O * line.start_O;
  const Eigen::Vector3d end_C = T_C_O * line.end_O;
  if (start_C.z() < kMinLineDepth || end_C.z() < kMinLineDepth) return std::nullopt;
  const auto middle_px = camera.Project(0.5 * (start_C + end_C));
  if (!middle_px || !camera.IsInImage(*middle_px)) return std::nullopt;
  return MakeStretch(start_C.hnormalized(), end_C.hnormalized());
}

bool Fits(const LineWitnessOptions& options, const Stretch& line, const LineObservation& segment) {
  const auto seen = MakeStretch(segment.start, segment.end);
  if (!seen) return false;
  const double cosine = std::abs(seen->direction.dot(line.direction));
  if (cosine < std::cos(options.max_angle)) return false;
  if (std::max(line.Across(segment.start), line.Across(segment.end)) > options.max_distance) {
    return false;
  }
  const auto [from, to] = std::minmax({line.Along(segment.start), line.Along(segment.end)});
  const double overlap = std::min(to, line.length) - std::max(from, 0.0);
  return overlap >= options.min_overlap * std::min(line.length, seen->length);
}

}  // namespace

LineWitnesses FindWitnesses(const LineWitnessOptions& options, const CameraModel& camera,
                            const Rigid3d& T_O_C, const std::vector<SpaceSegment>& lines_O,
                            const std::vector<TrackedSegment>& segments) {
  const Rigid3d T_C_O = T_O_C.Inverse();
  LineWitnesses witnesses;
  for (const SpaceSegment& line : lines_O) {
    const auto image = Project(camera, T_C_O, line);
    if (!image) continue;
    ++witnesses.visible;
    const auto segment =
        std::find_if(segments.begin(), segments.end(), [&](const TrackedSegment& candidate) {
          return Fits(options, *image, candidate.observation);
        });
    if (segment != segments.end()) witnesses.seen.push_back({line, segment->observation});
  }
  return witnesses;
}

}  // namespace plm_vins
