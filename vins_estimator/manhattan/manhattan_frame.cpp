// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/manhattan/manhattan_frame.h"

#include <algorithm>

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr double kAxisSigma = M_PI / 180;      // deviation of built lines from their axis [rad]
constexpr double kMaxLineSigma = M_PI / 60;    // lines less certain than this do not vote [rad]
constexpr double kMaxTolerance = M_PI / 45;    // greatest angle between a line and its axis [rad]
constexpr double kLockFalseAlarms = 1e-5;      // a heading with fewer expected ones is significant
constexpr double kKeepFalseAlarms = 1;         // a heading with more is no better than chance
constexpr double kLockShare = 0.45;            // of the horizontal lines that support the heading
constexpr double kLockSigma = M_PI / 900;      // greatest standard error of the heading [rad]
constexpr int kLockLines = 15;                 // least number of distinct supporting lines
constexpr double kLockAfter = 5;               // time for which it must have been a candidate [s]
constexpr double kCandidateShift = M_PI / 90;  // a candidate that moves further is a new one [rad]
constexpr double kRevokeAfter = 3;             // duration of a contradiction that revokes it [s]
constexpr double kRevokeShift = M_PI / 180;  // shift of the mean heading that contradicts it [rad]

// Returns the angle between a line's direction and an axis, regardless of sign [rad].
double AngleBetween(const Eigen::Vector3d& direction, const Eigen::Vector3d& axis) {
  return std::atan2(direction.cross(axis).norm(), std::abs(direction.dot(axis)));
}

bool IsSignificant(const HeadingSupport& support) {
  return support.log_false_alarms < std::log(kLockFalseAlarms) && support.share() > kLockShare &&
         support.lines >= kLockLines && support.sigma < kLockSigma;
}

double Tolerance(double sigma) {
  return std::min(kMaxTolerance, 3 * std::hypot(sigma, kAxisSigma));
}

}  // namespace

bool ManhattanFrame::IsKnownWell(const LineDirection& line) { return line.sigma < kMaxLineSigma; }

void ManhattanFrame::Update(int64_t t_ns, const std::vector<LineDirection>& lines) {
  const double elapsed = last_ns_ ? ToSeconds(t_ns - *last_ns_) : 0;
  last_ns_ = t_ns;
  Vote(lines, elapsed);
  if (state_ == ManhattanState::kLocked) {
    Check(t_ns);
  } else {
    Search(t_ns);
  }
}

void ManhattanFrame::Vote(const std::vector<LineDirection>& lines, double elapsed) {
  votes_.Fade(elapsed);
  for (const LineDirection& line : lines) {
    const Eigen::Vector3d& d = line.direction_W;
    const double horizontal_part = d.head<2>().norm();
    const double elevation = std::atan2(std::abs(d.z()), horizontal_part);
    if (!IsKnownWell(line) || elevation > Tolerance(line.sigma)) continue;
    votes_.Cast(line.id, std::atan2(d.y(), d.x()), line.sigma, elapsed);
  }
}

// Tracks the best supported heading and locks it once it was significant for long enough.
void ManhattanFrame::Search(int64_t t_ns) {
  support_ = votes_.Best();
  const bool goes_on = state_ == ManhattanState::kCandidate &&
                       std::abs(WrapQuarterTurn(support_.heading - heading_)) < kCandidateShift &&
                       support_.log_false_alarms < std::log(kKeepFalseAlarms);
  if (!goes_on) {
    if (!IsSignificant(support_)) {
      if (state_ == ManhattanState::kCandidate) state_ = ManhattanState::kAbsent;
      return;
    }
    state_ = ManhattanState::kCandidate;
    heading_ = support_.heading;
    since_ns_ = t_ns;
  }
  if (ToSeconds(t_ns - *since_ns_) < kLockAfter || !IsSignificant(support_)) return;
  state_ = ManhattanState::kLocked;
  heading_ = support_.heading;
  since_ns_.reset();
}

// Keeps the locked heading unless the lines contradict it for some time.
void ManhattanFrame::Check(int64_t t_ns) {
  support_ = votes_.At(heading_);
  if (!Contradicted()) {
    since_ns_.reset();
    return;
  }
  if (!since_ns_) since_ns_ = t_ns;
  if (ToSeconds(t_ns - *since_ns_) < kRevokeAfter) return;
  state_ = ManhattanState::kRevoked;
  votes_.Clear();
  since_ns_.reset();
}

// Returns whether the lines significantly support another heading, or their mean heading has
// shifted.
bool ManhattanFrame::Contradicted() const {
  if (support_.log_false_alarms > std::log(kKeepFalseAlarms)) {
    return IsSignificant(votes_.Best());
  }
  const double shift = std::abs(WrapQuarterTurn(support_.heading - heading_));
  return shift > kRevokeShift + 3 * support_.sigma;
}

std::optional<Eigen::Quaterniond> ManhattanFrame::R_W_M() const {
  if (state_ != ManhattanState::kLocked) return std::nullopt;
  return Eigen::Quaterniond(Eigen::AngleAxisd(heading_, Eigen::Vector3d::UnitZ()));
}

LineAxis ManhattanFrame::AxisOf(const LineDirection& line) const {
  if (!IsKnownWell(line)) return LineAxis::kFree;
  const double tolerance = Tolerance(line.sigma);
  for (const LineAxis axis : {LineAxis::kZ, LineAxis::kX, LineAxis::kY}) {
    if (axis != LineAxis::kZ && state_ != ManhattanState::kLocked) break;
    if (AngleBetween(line.direction_W, AxisInWorld(axis)) < tolerance) return axis;
  }
  return LineAxis::kFree;
}

Eigen::Vector3d ManhattanFrame::AxisInWorld(LineAxis axis) const {
  return Eigen::AngleAxisd(heading_, Eigen::Vector3d::UnitZ()) * UnitVector(axis);
}

}  // namespace plm_vins
