// SPDX-License-Identifier: BSD-3-Clause
// The estimator where the ground is near.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/vins_estimator/estimated_flight.h"
#include "test/vins_estimator/planned_flight.h"

namespace plm_vins {
namespace {

constexpr double kRest = 3, kClimb = 4, kTop = 3;  // [s], [s], [m]

// A camera that looks down rests at `height`, climbs straight up to 3 m, and stays there. Points on
// the ground are as dense in the image at every height.
testing::FlightPlan TakeOff(double height, uint64_t seed) {
  testing::FlightPlan plan;
  plan.duration = kRest + kClimb + 3;
  plan.nearest = 0.01;
  plan.min_dist_px = 20;
  plan.T_W_V = [height](double t) {
    const double share = testing::SmoothStep(t, kRest, kRest + kClimb);
    return Rigid3d(SO3Exp({0, M_PI / 2, 0}), {0, 0, height + (kTop - height) * share});
  };
  simulator::Random random(seed);
  for (int i = 0; i < 3000; ++i) {
    const double radius = 0.01 * std::pow(500, random.Uniform(0, 1));
    const double direction = random.Uniform(-M_PI, M_PI);
    plan.points_W.emplace_back(radius * std::cos(direction), radius * std::sin(direction), 0);
  }
  return plan;
}

// Heights are true within 3 %, or within three stated deviations.
TEST(EstimatorTakeOff, HeightIsAccurateFromTheGround) {
  for (const double height : {0.08, 0.1, 0.15, 0.3}) {
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      const auto flight =
          testing::Estimate(testing::PlannedFlight(TakeOff(height, seed)).Simulate());
      ASSERT_TRUE(flight.restarts.empty());
      const int64_t begin_ns = flight.outputs.front().t_ns;
      for (size_t i = 0; i < flight.outputs.size(); ++i) {
        const EstimatorOutput& output = flight.outputs[i];
        if (ToSeconds(output.t_ns - begin_ns) < kRest + 2) continue;
        const double climbed = flight.truth[i].position().z() - flight.truth[0].position().z();
        const double error =
            output.state.position().z() - flight.outputs[0].state.position().z() - climbed;
        const double deviation = std::sqrt(testing::PoseCovariance(output)(2, 2));
        EXPECT_LT(std::abs(error), std::max(0.03 * climbed, 3 * deviation))
            << height << " m, seed " << seed << ", image " << i << ", climbed " << climbed;
      }
    }
  }
}

}  // namespace
}  // namespace plm_vins
