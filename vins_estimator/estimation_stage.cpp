// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {
namespace {

MeasurementSync::Options MakeSyncOptions(const Config& config) {
  MeasurementSync::Options options;
  options.td = config.sensor.td;
  options.expect_lines = config.use_lines;
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
          {"frames_without_imu", statistics.frames_without_imu, ""},
          {"frames_in_imu_gap", statistics.frames_in_imu_gap, ""},
          {"frames_too_close", statistics.frames_too_close, ""},
          {"frames_dropped_full", statistics.frames_dropped_full, ""},
          {"frames_with_few_points", statistics.frames_with_few_points, ""},
          {"lines_out_of_order", statistics.lines_out_of_order, ""},
          {"lines_late", statistics.lines_late, ""}};
}

EstimationStage::EstimationStage(const Config& config)
    : estimator_(config), sync_(MakeSyncOptions(config)) {}

void EstimationStage::Reset() {
  sync_.Clear();
  estimator_.Reset();
  sync_.SetTimeOffset(estimator_.time_offset());
}

std::optional<EstimatedFrame> EstimationStage::Process(
    const std::optional<FrameMeasurement>& measurement) {
  if (!measurement) return std::nullopt;
  EstimatedFrame frame;
  frame.output = estimator_.Process(*measurement);
  sync_.SetTimeOffset(estimator_.time_offset());
  if (!measurement->imu.empty()) {
    frame.angular_velocity = measurement->imu.back().gyro - frame.output.state.gyro_bias();
  }
  return frame;
}

}  // namespace plm_vins
