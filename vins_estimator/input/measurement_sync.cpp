// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/measurement_sync.h"

#include <algorithm>
#include <utility>

namespace plm_vins {
namespace {

// Between images that are closer than this, the motion is below the noise.
constexpr int64_t kMinInterval_ns = 1'000'000;

constexpr size_t kFewPoints = 10;  // too few to estimate the camera's motion

}  // namespace

MeasurementSync::MeasurementSync(const Options& options)
    : options_(options),
      imu_(options.imu, options.max_imu_samples),
      lines_({options.expect_lines, options.max_line_lag, options.max_line_stall,
              options.line_patience, options.max_frames}),
      points_order_(kFeatureJumps) {}

AdmittedImu MeasurementSync::AddImu(const ImuSample& sample) {
  AdmittedImu admitted = imu_.Add(sample);
  statistics_.jumps_back += admitted.clock == ClockChange::kBack;
  statistics_.leaps_ahead += admitted.clock == ClockChange::kForward;
  if (admitted.clock != ClockChange::kNone) ClearFrames();
  return admitted;
}

bool MeasurementSync::AddPoints(PointFrame frame) {
  ++statistics_.frames;
  const StampVerdict verdict = points_order_.Add(frame.t_ns);
  const bool restarts = verdict == StampVerdict::kRestarts;
  statistics_.frames_out_of_order += verdict == StampVerdict::kIsBack || restarts;
  statistics_.frames_ahead_of_time += verdict == StampVerdict::kIsAhead;
  statistics_.jumps_back += restarts;
  if (!StampOrder::IsAccepted(verdict)) return false;
  if (restarts) {
    Clear();
    points_order_.Add(frame.t_ns);
  }
  if (frame.points.size() < kFewPoints) ++statistics_.frames_with_few_points;
  points_.push_back(std::move(frame));
  if (static_cast<int>(points_.size()) > options_.max_frames) {
    points_.pop_front();
    ++statistics_.frames_dropped_full;
  }
  return restarts;
}

void MeasurementSync::AddLines(LineFrame frame) {
  const bool image_waits =
      std::any_of(points_.begin(), points_.end(),
                  [&frame](const PointFrame& points) { return points.t_ns == frame.t_ns; });
  lines_.Add(std::move(frame), image_waits);
}

void MeasurementSync::Clear() {
  imu_.Clear();
  ClearFrames();
}

void MeasurementSync::ClearFrames() {
  points_.clear();
  points_order_.Clear();
  lines_.Clear();
}

std::optional<FrameMeasurement> MeasurementSync::Pop() {
  DropUnusableFrames();
  if (!OldestIsReached() || !LinesAreDecided(0)) return std::nullopt;
  return TakeFrame();
}

std::optional<FrameMeasurement> MeasurementSync::Flush() {
  DropUnusableFrames();
  if (OldestIsReached()) return TakeFrame();
  statistics_.frames_without_imu += static_cast<int64_t>(points_.size());
  points_.clear();
  return std::nullopt;
}

int64_t MeasurementSync::CutTime(size_t frame) const {
  return points_[frame].t_ns + ToNanoseconds(options_.td);
}

bool MeasurementSync::LinesAreDecided(size_t frame) const {
  return lines_.AreDecided(points_[frame].t_ns, NewerThan(frame));
}

LinePairing::NewerImages MeasurementSync::NewerThan(size_t frame) const {
  return {static_cast<int>(points_.size() - frame - 1),
          ToSeconds(points_.back().t_ns - points_[frame].t_ns)};
}

void MeasurementSync::DropUnusableFrames() {
  while (OldestIsReached()) {
    const auto defect = FindDefect();
    if (!defect) return;
    Count(*defect);
    points_.pop_front();
  }
}

std::optional<MeasurementSync::FrameDefect> MeasurementSync::FindDefect() const {
  const int64_t cut_ns = CutTime(0);
  const std::optional<int64_t> last_cut_ns = imu_.last_cut_ns();
  if (last_cut_ns && cut_ns - *last_cut_ns < kMinInterval_ns) return FrameDefect::kTooClose;
  if (cut_ns < imu_.first_ns()) return FrameDefect::kWithoutImu;
  if (imu_.IsInGap(cut_ns)) return FrameDefect::kInImuGap;
  if (IsTooLate()) return FrameDefect::kTooLate;
  return std::nullopt;
}

void MeasurementSync::Count(FrameDefect defect) {
  statistics_.frames_too_close += defect == FrameDefect::kTooClose;
  statistics_.frames_without_imu += defect == FrameDefect::kWithoutImu;
  statistics_.frames_in_imu_gap += defect == FrameDefect::kInImuGap;
  if (defect == FrameDefect::kTooLate) {
    ++statistics_.frames_too_late;
    statistics_.longest_wait = std::max(statistics_.longest_wait, LeadOfImu());
  }
}

bool MeasurementSync::IsTooLate() const {
  if (points_.size() < 2 || !LinesAreDecided(1)) return false;  // no newer frame is usable
  return LeadOfImu() > options_.max_wait && imu_.Reaches(CutTime(1));
}

double MeasurementSync::LeadOfImu() const { return ToSeconds(imu_.newest_ns() - CutTime(0)); }

FrameMeasurement MeasurementSync::TakeFrame() {
  FrameMeasurement measurement;
  measurement.t_ns = points_.front().t_ns;
  measurement.time_offset = options_.td;
  measurement.imu = imu_.Cut(CutTime(0));
  measurement.lines = lines_.Take(measurement.t_ns, NewerThan(0));
  measurement.points = std::move(points_.front());
  points_.pop_front();
  return measurement;
}

}  // namespace plm_vins
