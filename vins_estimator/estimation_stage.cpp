// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimation_stage.h"

#include "vins_estimator/estimator.h"

namespace plm_vins {
namespace {

MeasurementSync::Options MakeSyncOptions(const Config& config, double max_wait) {
  MeasurementSync::Options options;
  options.td = config.sensor.td;
  options.expect_lines = config.use_lines;
  options.max_wait = max_wait;
  return options;
}

}  // namespace

DropCounts ToDropCounts(const SyncStatistics& statistics) {
  return {{"imu_not_finite", statistics.imu_not_finite, ""},
          {"imu_implausible", statistics.imu_implausible, ""},
          {"imu_out_of_order", statistics.imu_out_of_order, ""},
          {"imu_gaps", statistics.imu_gaps, ""},
          {"imu_dropped_full", statistics.imu_dropped_full, ""},
          {"frames_out_of_order", statistics.frames_out_of_order, ""},
          {"frames_ahead_of_time", statistics.frames_ahead_of_time, ""},
          {"frames_too_late", statistics.frames_too_late, ""},
          {"frames_without_imu", statistics.frames_without_imu, ""},
          {"frames_in_imu_gap", statistics.frames_in_imu_gap, ""},
          {"frames_too_close", statistics.frames_too_close, ""},
          {"frames_dropped_full", statistics.frames_dropped_full, ""},
          {"frames_with_few_points", statistics.frames_with_few_points, ""},
          {"lines_out_of_order", statistics.lines_out_of_order, ""},
          {"lines_late", statistics.lines_late, ""},
          {"jumps_back", statistics.jumps_back, ""}};
}

EstimationStage::EstimationStage(const Config& config, double max_wait)
    : gyro_density_(config.sensor.imu_noise.gyro_density),
      estimator_(std::make_unique<Estimator>(config)),
      sync_(MakeSyncOptions(config, max_wait)) {}

EstimationStage::~EstimationStage() = default;

void EstimationStage::Reset(const std::string& reason) {
  sync_.Clear();
  StartOver(reason);
}

// Without an output since the last start no world frame is given up, so none is announced.
void EstimationStage::StartOver(const std::string& reason) {
  estimator_->Reset();
  sync_.SetTimeOffset(estimator_->time_offset());
  if (anew_) return;
  ++resets_;
  restart_reason_ = reason;
  anew_ = true;
}

std::optional<EstimatedFrame> EstimationStage::Process(
    const std::optional<FrameMeasurement>& measurement) {
  if (!measurement) return std::nullopt;
  if (sync_.statistics().jumps_back > jumps_back_) {
    jumps_back_ = sync_.statistics().jumps_back;
    StartOver("stamps jumped back");
  }
  EstimatedFrame frame;
  frame.output = estimator_->Process(*measurement);
  frame.points = measurement->points;
  if (measurement->lines) frame.lines = *measurement->lines;
  ++frames_;
  if (frame.output.restarted) ++resets_;
  anew_ = false;
  if (restart_reason_) {
    frame.output.restarted = true;
    frame.output.reason = *std::exchange(restart_reason_, std::nullopt);
  }
  sync_.SetTimeOffset(estimator_->time_offset());
  const std::vector<ImuSample>& imu = measurement->imu;
  if (imu.size() > 1) {
    const double interval =
        ToSeconds(imu.back().t_ns - imu.front().t_ns) / static_cast<double>(imu.size() - 1);
    frame.angular_velocity = imu.back().gyro - frame.output.state.gyro_bias();
    frame.angular_velocity_variance = gyro_density_ * gyro_density_ / interval;
  }
  return frame;
}

}  // namespace plm_vins
