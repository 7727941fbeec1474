// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/visual_inertial_bundle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/camera/camera_model.h"
#include "test/vins_estimator/initialization/simulated_frames.h"
#include "vins_estimator/geometry/point_triangulation.h"

namespace plm_vins {
namespace {

constexpr int kViews = 11;
constexpr int kImagesPerView = 5;
constexpr double kMinAngle = 0.01;  // between the rays of a usable point [rad]

// Some images of a fast flight, with true states, observations and IMU samples.
struct Problem {
  std::vector<FrameState> truth;
  std::vector<Track> tracks;
  std::vector<std::optional<Eigen::Vector3d>> p_W;
  std::vector<Preintegration> preintegrations;
  VisualInertialBundleOptions options;

  explicit Problem(uint64_t seed) {
    const simulator::FeatureSimulationOptions simulation =
        testing::FlightOptions(simulator::Motion::kFast, seed);
    const testing::SimulatedFlight flight = testing::SimulateFlight(simulation, 3);
    const double focal_length =
        CameraModel::Create(flight.sensor.cameras[0].parameters)->FocalLength();
    options = {{flight.sensor.cameras[0].T_B_C},
               flight.sensor.gravity_norm,
               simulation.point_noise_px / focal_length,
               flight.sensor.accel_bias_deviation};
    std::vector<const PointFrame*> views;
    std::vector<ImuSample> imu;
    for (int i = 0; i <= kImagesPerView * (kViews - 1); ++i) {
      if (i > 0) JoinImu(flight.frames[i].imu, &imu);
      if (i % kImagesPerView != 0) continue;
      if (i > 0) AddInterval(flight.sensor.imu_noise, imu);
      imu.clear();
      views.push_back(&flight.frames[i].points);
      truth.push_back(flight.truth[i]);
    }
    tracks = CollectTracks(views);
    for (const Track& track : tracks) p_W.push_back(Triangulate(track));
  }

  void AddInterval(const ImuNoise& noise, const std::vector<ImuSample>& imu) {
    preintegrations.emplace_back(noise, truth.back().bias());
    for (const ImuSample& sample : imu) preintegrations.back().Append(sample);
  }

  std::optional<Eigen::Vector3d> Triangulate(const Track& track) const {
    std::vector<PosedPointObservation> observations;
    for (const Track::Observation& o : track.observations) {
      observations.push_back({truth[o.view].T_W_B() * options.T_B_C[o.camera], o.xy});
    }
    return TriangulatePoint(observations, kMinAngle);
  }

  // Scales the points by `factor` about the first position; returns the states accordingly.
  std::vector<FrameState> Scale(double factor) {
    const Eigen::Vector3d origin = truth.front().position();
    std::vector<FrameState> states = truth;
    for (FrameState& state : states) {
      state.SetPose(
          {Eigen::Quaterniond(state.rotation()), origin + factor * (state.position() - origin)});
      state.velocity() *= factor;
    }
    for (auto& p : p_W) {
      if (p) *p = origin + factor * (*p - origin);
    }
    return states;
  }
};

double SizeOf(const std::vector<FrameState>& states) {
  std::vector<Eigen::Vector3d> positions;
  for (const FrameState& state : states) positions.push_back(state.position());
  return testing::SizeOf(positions);
}

TEST(VisualInertialBundle, FindsStatesAndScaleDeviation) {
  constexpr int kFlights = 10;
  double squared_sum = 0;
  for (uint64_t seed = 1; seed <= kFlights; ++seed) {
    Problem problem(seed);
    std::vector<FrameState> states = problem.Scale(1.1);
    std::string reason;
    const auto bundle = AdjustVisualInertialBundle(
        problem.tracks, problem.p_W, problem.preintegrations, problem.options, &states, &reason);
    ASSERT_TRUE(bundle) << reason;
    EXPECT_NEAR(bundle->reprojection_rms, 0.55, 0.1);  // for Gaussian noise with Cauchy weights
    EXPECT_LT(bundle->imu_rms, 0.5);  // there are few more equations than variables
    const double error = std::log(SizeOf(states) / SizeOf(problem.truth));
    EXPECT_LT(std::abs(error), 0.05);
    squared_sum += std::pow(error / bundle->relative_scale_deviation, 2);
    EXPECT_LT((states.front().position() - problem.truth.front().position()).norm(), 1e-3);
    for (size_t i = 0; i < states.size(); ++i) {
      EXPECT_LT(testing::GravityError(states[i], problem.truth[i]), 0.02);
      EXPECT_LT(testing::VelocityError(states[i], problem.truth[i]), 0.1);
    }
  }
  EXPECT_GT(squared_sum / kFlights, 0.2);
  EXPECT_LT(squared_sum / kFlights, 3.0);
}

TEST(VisualInertialBundle, RejectsWithoutPoints) {
  Problem problem(1);
  std::vector<FrameState> states = problem.truth;
  problem.p_W.assign(problem.tracks.size(), std::nullopt);
  std::string reason;
  EXPECT_FALSE(AdjustVisualInertialBundle(problem.tracks, problem.p_W, problem.preintegrations,
                                          problem.options, &states, &reason));
  EXPECT_EQ(reason, "the visual-inertial bundle adjustment is degenerate");
}

}  // namespace
}  // namespace plm_vins
