// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/measurement_sync.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/imu/imu_interpolation.h"
#include "common/imu/imu_range.h"

namespace plm_vins {
namespace {

// Between images whose IMU cuts are closer than this, motion is lost in the noise.
constexpr int64_t kMinInterval_ns = 1'000'000;

// Stamps in a row that go back until a new recording begins. Trackers check stamps, too, and should
// be the first to decide.
constexpr int kImuJumpPatience = 1000;
constexpr int kPointsJumpPatience = 10;

// Our trackers are stricter; this check is for those of others.
constexpr int64_t kPointsLeap_ns = 10'000'000'000;

// A longer gap means that the clock was set on: the IMU bridges no pause of that length.
constexpr int64_t kImuLeap_ns = 60'000'000'000;

constexpr size_t kFewPoints = 10;  // too few to estimate the motion of the camera

}  // namespace

MeasurementSync::MeasurementSync(const Options& options)
    : options_(options),
      imu_gate_(options.imu_range),
      imu_jump_(kImuJumpPatience),
      points_jump_(kPointsJumpPatience),
      points_leap_(kPointsLeap_ns) {}

void MeasurementSync::AddImu(const ImuSample& sample) {
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) {
    ++statistics_.imu_not_finite;
    return;
  }
  if (!IsPlausible(sample)) {
    ++statistics_.imu_implausible;
    return;
  }
  const bool follows = !last_imu_ns_ || sample.t_ns > *last_imu_ns_;
  if (!follows) {
    ++statistics_.imu_out_of_order;
    // Where a recording is played again, what leads up to them was refused.
    if (!imu_jump_.Refuses() && imu_memory_.Contains(sample)) return;
  }
  if (follows ? imu_jump_.EndsStepBack(sample.t_ns) : imu_jump_.Refuse(sample.t_ns)) {
    ++statistics_.jumps_back;
    Clear();
  } else if (!follows) {
    return;
  }
  imu_jump_.Accept();
  JudgeImuAfterGap(sample.t_ns);
  if (last_imu_ns_ && ToSeconds(sample.t_ns - *last_imu_ns_) > options_.max_imu_gap) {
    imu_after_gap_ = sample;
  } else {
    TakeImu(sample);
  }
}

void MeasurementSync::JudgeImuAfterGap(int64_t next_ns) {
  if (!imu_after_gap_) return;
  const ImuSample sample = *std::exchange(imu_after_gap_, std::nullopt);
  if (next_ns <= sample.t_ns) {
    ++statistics_.imu_out_of_order;
    return;
  }
  if (sample.t_ns - *last_imu_ns_ > kImuLeap_ns) {
    ++statistics_.leaps_ahead;
    Clear();
  } else {
    ++statistics_.imu_gaps;
  }
  TakeImu(sample);
}

void MeasurementSync::TakeImu(const ImuSample& sample) {
  last_imu_ns_ = sample.t_ns;
  imu_memory_.Add(sample);
  for (const ImuSample& decided : imu_gate_.Add(sample)) QueueImu(decided);
  statistics_.imu_replaced = imu_gate_.replaced();
  statistics_.imu_saturated = imu_gate_.saturated();
}

void MeasurementSync::QueueImu(const ImuSample& sample) {
  imu_.push_back(sample);
  if (static_cast<int>(imu_.size()) > options_.max_imu_samples) {
    // The boundary of the last cut stays, so that the next interval keeps its length.
    imu_.erase(imu_.begin() + (last_cut_ns_ ? 1 : 0));
    ++statistics_.imu_dropped_full;
  }
}

void MeasurementSync::AddPoints(PointFrame frame) {
  ++statistics_.frames;
  if (last_points_ns_ && frame.t_ns <= *last_points_ns_) {
    ++statistics_.frames_out_of_order;
    if (!points_jump_.Refuse(frame.t_ns)) return;
    ++statistics_.jumps_back;
    Clear();
  } else if (last_points_ns_ && !points_leap_.Accept(*last_points_ns_, frame.t_ns)) {
    ++statistics_.frames_ahead_of_time;
    return;
  }
  points_jump_.Accept();
  last_points_ns_ = frame.t_ns;
  if (frame.points.size() < kFewPoints) ++statistics_.frames_with_few_points;
  points_.push_back(std::move(frame));
  if (static_cast<int>(points_.size()) > options_.max_frames) {
    points_.pop_front();
    ++statistics_.frames_dropped_full;
  }
}

void MeasurementSync::AddLines(LineFrame frame) {
  if (last_lines_ns_ && frame.t_ns <= *last_lines_ns_) {
    ++statistics_.lines_out_of_order;
    if (frame.t_ns == *last_lines_ns_) return;
    // The tracker started over: what it said of later times is not of this recording.
    while (!lines_.empty() && lines_.back().t_ns >= frame.t_ns) lines_.pop_back();
  }
  last_lines_ns_ = frame.t_ns;
  if (lines_are_missing() && IsInTime(frame.t_ns)) frames_without_lines_in_a_row_ = 0;
  if (!last_popped_ns_.empty() && frame.t_ns <= last_popped_ns_.back()) {
    ++statistics_.lines_late;
    return;
  }
  lines_.push_back(std::move(frame));
  if (static_cast<int>(lines_.size()) > options_.max_frames) {
    lines_.pop_front();
    ++statistics_.lines_without_points;
  }
}

void MeasurementSync::Clear() {
  imu_.clear();
  imu_memory_.Clear();
  imu_gate_.Clear();
  imu_jump_.Accept();  // whatever comes next
  last_imu_ns_.reset();
  imu_after_gap_.reset();
  points_.clear();
  lines_.clear();
  last_cut_ns_.reset();
  last_points_ns_.reset();
  last_lines_ns_.reset();
  last_popped_ns_.clear();
}

std::optional<FrameMeasurement> MeasurementSync::Pop() {
  DropUnusableFrames();
  if (points_.empty() || imu_.empty() || imu_.back().t_ns < CutTime()) return std::nullopt;
  if (!LinesAreDecided(0)) return std::nullopt;
  return TakeFrame();
}

std::optional<FrameMeasurement> MeasurementSync::Flush() {
  DropUnusableFrames();
  if (!points_.empty() && !imu_.empty() && imu_.back().t_ns >= CutTime()) return TakeFrame();
  statistics_.frames_without_imu += static_cast<int64_t>(points_.size());
  points_.clear();
  return std::nullopt;
}

int64_t MeasurementSync::CutTime() const {
  return points_.front().t_ns + ToNanoseconds(options_.td);
}

size_t MeasurementSync::FirstImuNotBefore(int64_t t_ns) const {
  const auto first =
      std::lower_bound(imu_.begin(), imu_.end(), t_ns,
                       [](const ImuSample& sample, int64_t t) { return sample.t_ns < t; });
  return static_cast<size_t>(std::distance(imu_.begin(), first));
}

bool MeasurementSync::LinesAreDecided(size_t frame) const {
  if (!options_.expect_lines || lines_are_missing()) return true;
  const bool there_or_passed = !lines_.empty() && lines_.back().t_ns >= points_[frame].t_ns;
  return there_or_passed || static_cast<int>(points_.size() - frame) > options_.max_line_lag;
}

bool MeasurementSync::IsInTime(int64_t lines_ns) const {
  const auto& popped = last_popped_ns_;
  return std::find(popped.begin(), popped.end(), lines_ns) != popped.end() ||
         std::any_of(points_.begin(), points_.end(),
                     [&](const PointFrame& points) { return points.t_ns == lines_ns; });
}

void MeasurementSync::DropUnusableFrames() {
  while (!points_.empty() && !imu_.empty() && imu_.back().t_ns >= CutTime()) {
    const auto defect = FindDefect();
    if (!defect) return;
    Count(*defect);
    points_.pop_front();
  }
}

std::optional<MeasurementSync::FrameDefect> MeasurementSync::FindDefect() const {
  const int64_t cut_ns = CutTime();
  if (last_cut_ns_ && cut_ns - *last_cut_ns_ < kMinInterval_ns) return FrameDefect::kTooClose;
  if (cut_ns < imu_.front().t_ns) return FrameDefect::kWithoutImu;
  const size_t next = FirstImuNotBefore(cut_ns);
  const bool between_samples = imu_[next].t_ns > cut_ns;
  if (between_samples && ToSeconds(imu_[next].t_ns - imu_[next - 1].t_ns) > options_.max_imu_gap) {
    return FrameDefect::kInImuGap;
  }
  if (IsTooLate()) return FrameDefect::kTooLate;
  return std::nullopt;
}

void MeasurementSync::Count(FrameDefect defect) {
  statistics_.frames_too_close += defect == FrameDefect::kTooClose;
  statistics_.frames_without_imu += defect == FrameDefect::kWithoutImu;
  statistics_.frames_in_imu_gap += defect == FrameDefect::kInImuGap;
  statistics_.frames_too_late += defect == FrameDefect::kTooLate;
}

bool MeasurementSync::IsTooLate() const {
  if (points_.size() < 2 || !LinesAreDecided(1)) return false;  // nothing newer could be used
  const int64_t newest_ns = imu_.back().t_ns;
  return ToSeconds(newest_ns - CutTime()) > options_.max_wait &&
         newest_ns >= points_[1].t_ns + ToNanoseconds(options_.td);
}

FrameMeasurement MeasurementSync::TakeFrame() {
  FrameMeasurement measurement;
  measurement.t_ns = points_.front().t_ns;
  measurement.time_offset = options_.td;
  measurement.imu = CutImu(CutTime());
  measurement.lines = TakeLines(measurement.t_ns);
  measurement.points = std::move(points_.front());
  points_.pop_front();
  last_popped_ns_.push_back(measurement.t_ns);
  if (static_cast<int>(last_popped_ns_.size()) > options_.max_line_lag) last_popped_ns_.pop_front();
  return measurement;
}

std::vector<ImuSample> MeasurementSync::CutImu(int64_t cut_ns) {
  const size_t next = FirstImuNotBefore(cut_ns);
  const ImuSample boundary =
      next == 0 ? imu_.front() : InterpolateImu(imu_[next - 1], imu_[next], cut_ns);
  const auto end = imu_.begin() + static_cast<std::ptrdiff_t>(next);
  std::vector<ImuSample> samples(imu_.begin(), end);
  samples.push_back(boundary);

  // The boundary takes the place of all that was handed out: it opens the next interval.
  const bool on_sample = imu_[next].t_ns == cut_ns;
  imu_.erase(imu_.begin(), on_sample ? std::next(end) : end);
  imu_.push_front(boundary);
  last_cut_ns_ = cut_ns;
  return samples;
}

std::optional<LineFrame> MeasurementSync::TakeLines(int64_t t_ns) {
  while (!lines_.empty() && lines_.front().t_ns < t_ns) {
    lines_.pop_front();
    ++statistics_.lines_without_points;
    ++unpaired_lines_in_a_row_;
  }
  if (lines_.empty() || lines_.front().t_ns != t_ns) {
    if (options_.expect_lines) {
      ++statistics_.frames_without_lines;
      ++frames_without_lines_in_a_row_;
    }
    return std::nullopt;
  }
  frames_without_lines_in_a_row_ = 0;
  unpaired_lines_in_a_row_ = 0;
  LineFrame lines = std::move(lines_.front());
  lines_.pop_front();
  return lines;
}

}  // namespace plm_vins
