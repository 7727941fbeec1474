// SPDX-License-Identifier: BSD-3-Clause
// Covariances of the estimation stage while a configured length may still be wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {
namespace {

struct Published {
  double most_nees = 0;       // of positions
  double greatest_error = 0;  // [m]
  double last_deviation = 0;  // root of the trace of the position's covariance [m]
  bool length_is_wrong = false;
};

// Publishes poses as the nodes do, until a length is found wrong.
Published PublishWithDepths(double factor) {
  auto options = testing::FlightOptions(simulator::Motion::kGentle, 1);
  options.sensors.depth.emplace();
  testing::SimulatedFlight flight =
      testing::WithoutLines(testing::SimulateFlight(options, /*skip=*/0.5));
  for (FrameMeasurement& frame : flight.frames) {
    for (PointObservation& point : frame.points.points) {
      if (point.depth) *point.depth *= factor;
    }
  }
  Config config = testing::ConfigFor(flight);
  config.use_lines = false;
  EstimationStage stage(config);
  Published published;
  std::optional<Rigid3d> T_true_W;
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    const FrameMeasurement& frame = flight.frames[i];
    for (size_t k = i > 0 ? 1 : 0; k < frame.imu.size(); ++k) stage.AddImu(frame.imu[k]);
    stage.AddPoints(frame.points);
    while (const auto estimate = stage.Pop()) {
      published.length_is_wrong = stage.has_found_wrong_length();
      if (published.length_is_wrong) return published;
      const EstimatorOutput& output = estimate->output;
      if (!output.has_pose) continue;
      const FrameState& truth =
          *std::find_if(flight.truth.begin(), flight.truth.end(),
                        [&](const FrameState& state) { return state.t_ns == output.t_ns; });
      if (!T_true_W) T_true_W = testing::AlignHeading(output.state, truth);
      const Eigen::Vector3d error_W =
          output.state.position() - T_true_W->Inverse() * truth.position();
      const Eigen::Matrix3d covariance = testing::PoseCovariance(output).topLeftCorner<3, 3>();
      published.most_nees =
          std::max(published.most_nees, error_W.dot(covariance.inverse() * error_W));
      published.greatest_error = std::max(published.greatest_error, error_W.norm());
      published.last_deviation = std::sqrt(covariance.trace());
    }
  }
  return published;
}

TEST(EstimationStageLengths, StateHowWrongALengthMayBeUntilItIsTested) {
  for (const double factor : {10.0, 2.5, 0.5}) {
    const Published published = PublishWithDepths(factor);
    EXPECT_TRUE(published.length_is_wrong) << factor;
    EXPECT_GT(published.greatest_error, 0.01) << factor;
    EXPECT_LT(published.most_nees, 25) << factor;
  }
}

TEST(EstimationStageLengths, StateMillimetersOnceALengthFits) {
  const Published published = PublishWithDepths(1);
  EXPECT_FALSE(published.length_is_wrong);
  EXPECT_LT(published.most_nees, 16);
  EXPECT_LT(published.last_deviation, 0.03);
}

}  // namespace
}  // namespace plm_vins
