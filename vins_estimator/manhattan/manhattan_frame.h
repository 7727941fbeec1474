// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/manhattan/heading_votes.h"
#include "vins_estimator/state/line_axis.h"

namespace plm_vins {

// A triangulated line's direction in W.
struct LineDirection {
  int64_t id = -1;
  Eigen::Vector3d direction_W = Eigen::Vector3d::UnitX();  // unit, of either sign
  double sigma = 0;                                        // standard deviation [rad]
};

// What is known of the Manhattan frame.
enum class ManhattanState {
  kAbsent,     // the lines show no common heading
  kCandidate,  // they do, but not long or exactly enough
  kLocked,     // the frame is known, and stays as it is
  kRevoked,    // it was known, until the lines contradicted it; the search goes on as from kAbsent
};

struct ManhattanOptions {
  HeadingVotesOptions votes;
  double axis_sigma = M_PI / 180;        // how true to an axis lines are built [rad]
  double max_line_sigma = M_PI / 60;     // a line less certain than this is not asked (3 deg) [rad]
  double max_tolerance = M_PI / 45;      // between a line and its axis, at most (4 deg) [rad]
  double lock_false_alarms = 1e-5;       // a heading is significant below this expectation ...
  double keep_false_alarms = 1.0;        // ... and no more than chance above this one
  double lock_share = 0.45;              // of the horizontal lines
  double lock_sigma = 0.2 * M_PI / 180;  // standard error of the heading [rad]
  int lock_lines = 15;                   // distinct lines that support it
  double lock_after = 5.0;               // it must have been a candidate for so long [s]
  double candidate_shift = M_PI / 90;    // a candidate that moves by more is another one [rad]
  double revoke_after = 3.0;             // of contradiction [s]
  double revoke_shift = M_PI / 180;      // of the lines' mean heading, that contradicts [rad]
};

// The frame M that a built scene follows: z up as in W, x and y along the horizontal lines. Gravity
// gives z, so one heading modulo 90 deg is all there is to find.
//
// The heading of W drifts, that of buildings does not. So the heading is estimated from the lines
// of several seconds and then held: from there on it is an outer reference for the heading of W,
// which one that follows the lines would not be. It never moves; it is revoked when the lines say
// something else for some time, and another one can then be found. Where lines are merely missing
// it stays.
class ManhattanFrame {
 public:
  explicit ManhattanFrame(const ManhattanOptions& options = {})
      : options_(options), votes_(options.votes) {}

  // The triangulated lines of the window at a frame; stamps must increase.
  void Update(int64_t t_ns, const std::vector<LineDirection>& lines);

  // Line `id` is another one's double: it has no vote of its own.
  void Remove(int64_t id) { votes_.Remove(id); }

  ManhattanState state() const { return state_; }

  // Nothing unless locked. A rotation about z by at most 45 deg.
  std::optional<Eigen::Quaterniond> R_W_M() const;

  // How well the lines of the last frames support the heading: of the frame when locked, else the
  // best one.
  const HeadingSupport& support() const { return support_; }

  // Accurate enough to be asked for its heading or its axis.
  bool IsKnownWell(const LineDirection& line) const { return line.sigma < options_.max_line_sigma; }

  // The axis that a line runs along, within its standard deviation. Only z while not locked.
  LineAxis AxisOf(const LineDirection& line) const;

  // Unit vector of an axis in W; not for kFree, and only z while not locked.
  Eigen::Vector3d AxisInWorld(LineAxis axis) const;

 private:
  void Vote(const std::vector<LineDirection>& lines, double elapsed);
  void Search(int64_t t_ns);
  void Check(int64_t t_ns);
  bool Significant(const HeadingSupport& support) const;
  bool Contradicted() const;
  double Tolerance(double sigma) const;

  ManhattanOptions options_;
  HeadingVotes votes_;
  ManhattanState state_ = ManhattanState::kAbsent;
  double heading_ = 0;  // of M in W when locked, of the first candidate when candidate [rad]
  HeadingSupport support_;
  std::optional<int64_t> last_ns_;   // of the last frame
  std::optional<int64_t> since_ns_;  // when it became candidate, or contradicted when locked
};

}  // namespace plm_vins
