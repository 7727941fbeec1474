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
  static bool IsKnownWell(const LineDirection& line);

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
  bool Contradicted() const;

  HeadingVotes votes_;
  ManhattanState state_ = ManhattanState::kAbsent;
  double heading_ = 0;  // M in W: locked, or at the start of the candidate [rad]
  HeadingSupport support_;
  std::optional<int64_t> last_ns_;   // time of the last frame
  std::optional<int64_t> since_ns_;  // start of the candidate, or of the contradiction when locked
};

}  // namespace plm_vins
