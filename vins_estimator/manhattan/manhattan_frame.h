// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/manhattan/heading_votes.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// Direction of a triangulated line in W.
struct LineDirection {
  int64_t id = -1;
  Eigen::Vector3d direction_W = Eigen::Vector3d::UnitX();  // unit vector of either sign
  double sigma = 0;                                        // standard deviation [rad]
};

// State of the search for the Manhattan frame.
enum class ManhattanState {
  kAbsent,     // the lines have no common heading
  kCandidate,  // a common heading exists, but not yet for long enough
  kLocked,     // the frame is known and held fixed
  kRevoked,    // the lines contradicted a locked frame; searches again as from kAbsent
};

struct ManhattanOptions {
  HeadingVotesOptions votes;
  double axis_sigma = M_PI / 180;     // deviation of built lines from their axis [rad]
  double max_line_sigma = M_PI / 60;  // lines less certain than this do not vote (3 deg) [rad]
  double max_tolerance = M_PI / 45;   // greatest angle between a line and its axis (4 deg) [rad]
  double lock_false_alarms = 1e-5;    // a heading with fewer expected false alarms is significant
  double keep_false_alarms = 1.0;     // a heading with more is no better than chance
  double lock_share = 0.45;  // least share of the horizontal lines that support the heading
  double lock_sigma = 0.2 * M_PI / 180;  // greatest standard error of the heading [rad]
  int lock_lines = 15;                   // least number of distinct supporting lines
  double lock_after = 5.0;               // time for which it must have been a candidate [s]
  double candidate_shift = M_PI / 90;    // a candidate that moves further is a new candidate [rad]
  double revoke_after = 3.0;             // duration of a contradiction that revokes the frame [s]
  double revoke_shift = M_PI / 180;      // shift of the mean heading that is a contradiction [rad]
};

// Estimates the Manhattan frame M of a built scene: z is up as in W, x and y run along the
// horizontal lines. Gravity gives z, so only the heading modulo 90 deg must be found.
//
// The heading of W drifts, that of buildings does not. The heading of M is therefore estimated from
// the lines of several seconds and then locked: it serves as an absolute reference for the heading
// of W, which a heading that followed the lines could not. The locked frame is never adjusted. It
// is revoked only when the lines contradict it for some time, after which another one can be found;
// missing lines do not revoke it.
class ManhattanFrame {
 public:
  explicit ManhattanFrame(const ManhattanOptions& options = {})
      : options_(options), votes_(options.votes) {}

  // Lets the triangulated lines of the window vote at the frame of time `t_ns`; timestamps must
  // increase.
  void Update(int64_t t_ns, const std::vector<LineDirection>& lines);

  // Removes the vote of line `id`, which was merged into another line.
  void Remove(int64_t id) { votes_.Remove(id); }

  ManhattanState state() const { return state_; }

  // Rotation from M to W, about z by at most 45 deg; nullopt unless locked.
  std::optional<Eigen::Quaterniond> R_W_M() const;

  // Support of the locked heading, or of the best one while not locked.
  const HeadingSupport& support() const { return support_; }

  // Returns whether the line is certain enough to vote and to be assigned an axis.
  bool IsKnownWell(const LineDirection& line) const { return line.sigma < options_.max_line_sigma; }

  // Returns the axis that the line is parallel to within its tolerance, kFree if none. While not
  // locked, only z is tested.
  LineAxis AxisOf(const LineDirection& line) const;

  // Returns the unit vector of an axis in W. Not defined for kFree, and only for z while not
  // locked.
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
  double heading_ = 0;  // M in W: locked, or at the start of the candidate [rad]
  HeadingSupport support_;
  std::optional<int64_t> last_ns_;   // time of the last frame
  std::optional<int64_t> since_ns_;  // start of the candidate, or of the contradiction when locked
};

}  // namespace plm_vins
