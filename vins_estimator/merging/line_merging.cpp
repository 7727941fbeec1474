// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/merging/line_merging.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

#include "vins_estimator/geometry/line_fit.h"
#include "vins_estimator/geometry/line_pairs.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;

constexpr size_t kViewsThatTell = 3;  // how well a line is known

// The seen part of a line, and how well its views tell its place. Few views are left of a line that
// started anew, but many have put it where it is.
std::optional<SeenLine> See(const SlidingWindow& window, const Eigen::Quaterniond& R_F_W,
                            double noise, const LineLandmark& landmark) {
  constexpr double kGreatestSigma = 0.5;  // [rad], [m]: beyond it, nothing is told apart anyway
  const auto segment = ObservedSegment(landmark, window);
  if (!segment) return std::nullopt;
  SeenLine seen{R_F_W * segment->start_W, R_F_W * segment->end_W, landmark.axis};
  if (landmark.views.size() < kViewsThatTell) return seen;
  const auto sightings = SightingsOf(landmark.views, window);
  const auto fit = EvaluateLine(sightings, noise, landmark.coordinates);
  if (!fit) return std::nullopt;
  const Eigen::Vector3d middle_W = 0.5 * (segment->start_W + segment->end_W);
  const Eigen::Vector3d middle_C0 = sightings.front().T_W_C.Inverse() * middle_W;
  seen.direction_sigma = std::min(DirectionDeviation(*fit), kGreatestSigma);
  seen.place_sigma = std::min(PlaceDeviation(*fit, middle_C0), kGreatestSigma);
  return seen;
}

// How far the ends of a seen segment are from the image of a line, at most; normalised.
double DistanceInImage(const SlidingWindow& window, const PluckerLine& line_W,
                       const LineView& view) {
  const Rigid3d T_C_W = window.T_W_C(*window.Find(view.t_ns)).Inverse();
  Vector2d distances;
  if (!EndPointDistances(view.segment, (T_C_W * line_W).moment, &distances, nullptr)) {
    return std::numeric_limits<double>::infinity();
  }
  return distances.cwiseAbs().maxCoeff();
}

// Each line's newest segment from the image of the other line.
double DistanceInImages(const SlidingWindow& window, const LineLandmark& a, const LineLandmark& b) {
  return std::max(DistanceInImage(window, LineInWorld(a, window), b.views.back()),
                  DistanceInImage(window, LineInWorld(b, window), a.views.back()));
}

// Two segments of one image that run beside each other, further apart than their noise.
bool AreSideBySide(const LineSegmentView& a, const LineSegmentView& b, double noise) {
  constexpr double kNoiseFactor = 3.0;
  constexpr double kLeastOverlap = 0.2;  // of the shorter
  const Vector2d along = (a.end - a.start).normalized();
  const auto [a_low, a_high] = std::minmax({along.dot(a.start), along.dot(a.end)});
  const auto [b_low, b_high] = std::minmax({along.dot(b.start), along.dot(b.end)});
  const double overlap = std::min(a_high, b_high) - std::max(a_low, b_low);
  if (overlap < kLeastOverlap * std::min(a_high - a_low, b_high - b_low)) return false;
  const Vector2d between = 0.5 * (b.start + b.end) - a.start;
  return std::abs(along.x() * between.y() - along.y() * between.x()) > kNoiseFactor * noise;
}

bool AreSeenSideBySide(const LineLandmark& a, const LineLandmark& b, double noise) {
  auto other = b.views.begin();
  for (const LineView& view : a.views) {
    while (other != b.views.end() && other->t_ns < view.t_ns) ++other;
    if (other == b.views.end()) return false;
    if (other->t_ns == view.t_ns && AreSideBySide(view.segment, other->segment, noise)) return true;
  }
  return false;
}

double Length(const LineView& view) { return (view.segment.end - view.segment.start).norm(); }

// The views of both by time; where one image shows both, the longer segment.
std::vector<LineView> JoinViews(const LineLandmark& a, const LineLandmark& b) {
  std::vector<LineView> views;
  std::merge(
      a.views.begin(), a.views.end(), b.views.begin(), b.views.end(), std::back_inserter(views),
      [](const LineView& first, const LineView& second) { return first.t_ns < second.t_ns; });
  size_t last = 0;
  for (size_t i = 1; i < views.size(); ++i) {
    if (views[i].t_ns != views[last].t_ns) {
      views[++last] = views[i];
    } else if (Length(views[i]) > Length(views[last])) {
      views[last] = views[i];
    }
  }
  views.resize(last + 1);
  return views;
}

// What a chi-square variable exceeds once in a thousand times ([Wilson1931]).
double ChiSquareLimit(int degrees_of_freedom) {
  constexpr double kNormalLimit = 3.09;
  const double v = 2.0 / (9.0 * degrees_of_freedom);
  return degrees_of_freedom * std::pow(1.0 - v + kNormalLimit * std::sqrt(v), 3);
}

// The best fit to the views of a line whose coordinates are about `line_W`.
std::optional<LineFit> Fit(const SlidingWindow& window, double noise,
                           const std::vector<LineView>& views, const PluckerLine& line_W) {
  const auto sightings = SightingsOf(views, window);
  const PluckerLine initial = sightings.front().T_W_C.Inverse() * line_W;
  return FitLine(sightings, noise, ToOrthonormal(initial));
}

// The older line with the views of both, where one line fits all of them, and not significantly
// worse than two lines do.
std::optional<LineLandmark> Join(const SlidingWindow& window, double noise,
                                 const LineLandmark& older, const LineLandmark& newer) {
  LineLandmark joint = older;
  joint.views = JoinViews(older, newer);
  const auto joint_fit = Fit(window, noise, joint.views, LineInWorld(older, window));
  const auto older_fit = Fit(window, noise, older.views, LineInWorld(older, window));
  const auto newer_fit = Fit(window, noise, newer.views, LineInWorld(newer, window));
  if (!joint_fit || !older_fit || !newer_fit) return std::nullopt;
  const int degrees_of_freedom = 2 * static_cast<int>(joint.views.size()) - kLineTangentSize;
  const double rise = joint_fit->cost - older_fit->cost - newer_fit->cost;
  if (degrees_of_freedom <= 0 || joint_fit->cost > ChiSquareLimit(degrees_of_freedom) ||
      rise > ChiSquareLimit(kLineTangentSize)) {
    return std::nullopt;
  }
  joint.coordinates = joint_fit->line;
  if (!ObservedSegment(joint, window)) return std::nullopt;
  return joint;
}

// The landmarks that may be merged, by ascending id, and their seen parts.
struct Candidates {
  std::vector<LineLandmark*> landmarks;
  std::vector<SeenLine> seen;
};

Candidates Collect(const SlidingWindow& window, const Eigen::Quaterniond& R_F_W, double noise,
                   LineMap* lines) {
  Candidates candidates;
  for (auto& [id, landmark] : lines->landmarks()) {
    if (!landmark.triangulated) continue;
    const auto seen = See(window, R_F_W, noise, landmark);
    if (!seen) continue;
    candidates.landmarks.push_back(&landmark);
    candidates.seen.push_back(*seen);
  }
  return candidates;
}

// The count of the first condition that two lines fail in space; null where they keep all.
int LineMergingCounts::*FindRefusal(const LineMergingOptions& options,
                                    const LinePairGeometry& pair) {
  constexpr double kDeviations = 3.0;
  if (pair.angle > std::max(options.angle, kDeviations * pair.angle_sigma)) {
    return &LineMergingCounts::other_direction;
  }
  if (pair.distance > std::max(options.distance, kDeviations * pair.distance_sigma)) {
    return &LineMergingCounts::distant;
  }
  return pair.gap > options.distance ? &LineMergingCounts::apart : nullptr;
}

// The same in space and in the images.
int LineMergingCounts::*FindRefusal(const LineMergingOptions& options, const SlidingWindow& window,
                                    const LineLandmark& a, const LineLandmark& b,
                                    const LinePairGeometry& pair) {
  if (const auto refusal = FindRefusal(options, pair)) return refusal;
  if (AreSeenSideBySide(a, b, options.noise)) return &LineMergingCounts::seen_side_by_side;
  if (DistanceInImages(window, a, b) > options.image_distance) {
    return &LineMergingCounts::distant_in_image;
  }
  return nullptr;
}

SeenLine Rotated(const Eigen::Quaterniond& R_F_W, const SeenLine& line_W) {
  SeenLine line_F = line_W;
  line_F.start_F = R_F_W * line_W.start_F;
  line_F.end_F = R_F_W * line_W.end_F;
  return line_F;
}

// Whether two lines could be near each other: the spheres around them touch.
bool MayTouch(const SeenLine& a, const SeenLine& b, double distance) {
  constexpr double kDeviations = 3.0;
  const double between = (a.start_F + a.end_F - b.start_F - b.end_F).norm();  // twice
  const double lengths = (a.end_F - a.start_F).norm() + (b.end_F - b.start_F).norm();
  return between < lengths + 2 * (distance + kDeviations * (a.place_sigma + b.place_sigma));
}

// How far the views of a landmark are from the image of another line, at most.
double DistanceInImages(const SlidingWindow& window, const PluckerLine& line_W,
                        const std::vector<LineView>& views) {
  double farthest = 0;
  for (const LineView& view : views) {
    farthest = std::max(farthest, DistanceInImage(window, line_W, view));
  }
  return farthest;
}

}  // namespace

LineMergingCounts LineMerging::Merge(const SlidingWindow& window, LineMap* lines,
                                     ManhattanFrame* manhattan) {
  const Eigen::Quaterniond R_F_W =
      manhattan->R_W_M().value_or(Eigen::Quaterniond::Identity()).conjugate();
  auto [landmarks, seen] = Collect(window, R_F_W, options_.noise, lines);
  LineMergingCounts counts;
  for (const auto& [newer, older] : FindNearPairs(seen, options_.distance)) {
    if (landmarks[newer] == nullptr || landmarks[older] == nullptr) continue;  // gone already
    ++counts.candidates;
    const auto refusal = FindRefusal(options_, window, *landmarks[older], *landmarks[newer],
                                     Compare(seen[older], seen[newer]));
    if (refusal != nullptr) {
      ++(counts.*refusal);
      continue;
    }
    const auto joint = Join(window, options_.noise, *landmarks[older], *landmarks[newer]);
    if (!joint) {
      ++counts.inconsistent;
      continue;
    }
    *landmarks[older] = *joint;
    seen[older] = See(window, R_F_W, options_.noise, *joint).value_or(seen[older]);
    Absorb(landmarks[newer]->id, joint->id, lines, manhattan);
    landmarks[newer] = nullptr;
    ++counts.merged;
  }
  for (size_t i = 0; i < landmarks.size(); ++i) {
    if (landmarks[i] == nullptr) continue;
    const auto older = Recognise(window, R_F_W, *landmarks[i], seen[i], *lines);
    if (!older) continue;
    Revive(landmarks[i]->id, *older, lines, manhattan);
    ++counts.recognised;
  }
  aliases_.RemoveUnless(
      [lines](int64_t id) { return lines->landmarks().find(id) != lines->landmarks().end(); });
  return counts;
}

void LineMerging::Absorb(int64_t newer, int64_t older, LineMap* lines, ManhattanFrame* manhattan) {
  aliases_.Add(newer, older);
  manhattan->Remove(newer);
  memory_.Join(newer, older);
  lines->landmarks().erase(newer);
}

// The remembered line that a landmark is, the nearest where several could be. All views of the
// landmark must show it where that line is: the images tell more than a first triangulation does.
std::optional<int64_t> LineMerging::Recognise(const SlidingWindow& window,
                                              const Eigen::Quaterniond& R_F_W,
                                              const LineLandmark& landmark, const SeenLine& seen_F,
                                              const LineMap& lines) const {
  if (landmark.views.size() < kViewsThatTell || memory_.Find(landmark.id)) return std::nullopt;
  const SeenLine seen_W = Rotated(R_F_W.conjugate(), seen_F);
  std::optional<int64_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [id, line] : memory_.lines()) {
    if (id > landmark.id) break;
    if (!MayTouch(line.seen_W, seen_W, options_.distance) || lines.landmarks().count(id)) continue;
    const LinePairGeometry pair = Compare(Rotated(R_F_W, line.seen_W), seen_F);
    if (pair.distance >= least || FindRefusal(options_, pair)) continue;
    const PluckerLine line_W = LineThrough(line.seen_W.start_F, line.seen_W.end_F);
    if (DistanceInImages(window, line_W, landmark.views) > options_.image_distance) continue;
    nearest = id;
    least = pair.distance;
  }
  return nearest;
}

// The landmark goes on under the id of the line that it is.
void LineMerging::Revive(int64_t newer, int64_t older, LineMap* lines, ManhattanFrame* manhattan) {
  auto landmark = lines->landmarks().extract(newer);
  landmark.key() = landmark.mapped().id = older;
  landmark.mapped().anchor_views = memory_.Find(older)->anchor_views;
  lines->landmarks().insert(std::move(landmark));
  aliases_.Add(newer, older);
  manhattan->Remove(newer);
}

void LineMerging::Remember(const SlidingWindow& window, const LineMap& lines, bool oldest_stays) {
  constexpr double kGreatestSigma = 0.2;  // [m]: a line known less well would not be recognised
  const int64_t oldest_ns = window.frames.front().state.t_ns;
  for (const auto& [id, landmark] : lines.landmarks()) {
    if (!LeavesWith(oldest_ns, landmark)) continue;
    const auto seen_W = See(window, Eigen::Quaterniond::Identity(), options_.noise, landmark);
    if (seen_W && landmark.views.size() >= kViewsThatTell && seen_W->place_sigma < kGreatestSigma) {
      memory_.Keep(id, *seen_W);
    }
    if (oldest_stays) memory_.KeepView(id, landmark.host());
  }
}

void LineMerging::Clear() {
  aliases_.Clear();
  memory_.Clear();
}

}  // namespace plm_vins
