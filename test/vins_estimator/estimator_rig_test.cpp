// SPDX-License-Identifier: BSD-3-Clause
// Estimation with a second camera that looks back: no point is observed by both.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/vins_estimator/estimated_flight.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::EstimatedFlight;
using testing::SimulatedFlight;

constexpr double kFocalLength = 460;  // [px]

// The points that the camera behind observes, and their tracks.
class BackCamera {
 public:
  explicit BackCamera(uint64_t seed) : random_(seed) {
    for (int i = 0; i < 1000; ++i) {
      points_W_.push_back(random_.Uniform(4, 8) * random_.NormalVector3().normalized());
    }
  }

  // Appends the observations of one image.
  void Observe(const Rigid3d& T_W_C, PointFrame* frame) {
    constexpr int kMaxPoints = 60;
    const double interval = ToSeconds(frame->t_ns - previous_ns_);
    std::map<size_t, PointObservation> observed;
    for (size_t i = 0; i < points_W_.size(); ++i) {
      const Vector3d p_C = T_W_C.Inverse() * points_W_[i];
      if (p_C.z() < 1 || p_C.hnormalized().cwiseAbs().maxCoeff() > 0.6) continue;
      if (static_cast<int>(observed.size()) == kMaxPoints) break;
      PointObservation& point = observed[i];
      const auto before = previous_.find(i);
      point.id = before == previous_.end() ? next_id_++ : before->second.id;
      point.camera = 1;
      const Vector2d noise_px = 0.5 * Vector2d(random_.Normal(), random_.Normal());
      point.xy = p_C.hnormalized() + noise_px / kFocalLength;
      point.uv_px = kFocalLength * point.xy + Vector2d(376, 240);
      if (before != previous_.end()) point.velocity = (point.xy - before->second.xy) / interval;
      frame->points.push_back(point);
    }
    previous_ = std::move(observed);
    previous_ns_ = frame->t_ns;
  }

 private:
  simulator::Random random_;
  std::vector<Vector3d> points_W_;
  std::map<size_t, PointObservation> previous_;  // by point
  int64_t previous_ns_ = 0, next_id_ = 1'000'000;
};

// A gentle flight with an accelerometer as noisy as propellers make it.
SimulatedFlight FrontFlight(uint64_t seed) {
  auto options = testing::FlightOptions(simulator::Motion::kGentle, seed);
  options.max_points = 60;
  options.point_break_probability = 0.05;
  options.sensors.imu_noise.accel_density = 0.03;
  return testing::WithoutLines(testing::SimulateFlight(options, /*skip=*/1));
}

SimulatedFlight WithBackCamera(SimulatedFlight flight, uint64_t seed) {
  CameraSensor back = flight.sensor.cameras[0];
  back.T_B_C = back.T_B_C * Rigid3d(SO3Exp({0, M_PI, 0}), {0.05, 0, -0.1});
  flight.sensor.cameras.push_back(back);
  BackCamera camera(seed);
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    camera.Observe(flight.truth[i].T_W_B() * back.T_B_C, &flight.frames[i].points);
  }
  return flight;
}

// Removes what the first camera observes from 6 to 11 s.
SimulatedFlight WithBlindFront(SimulatedFlight flight) {
  for (FrameMeasurement& frame : flight.frames) {
    const double t = ToSeconds(frame.t_ns - flight.frames.front().t_ns);
    if (t < 6 || t > 11) continue;
    std::vector<PointObservation>& points = frame.points.points;
    points.erase(std::remove_if(points.begin(), points.end(),
                                [](const PointObservation& point) { return point.camera == 0; }),
                 points.end());
  }
  return flight;
}

template <typename Fly>
double MeanRigError(const Fly& fly) {
  constexpr int kFlights = 8;
  double sum = 0;
  for (uint64_t seed = 1; seed <= kFlights; ++seed) {
    sum += testing::AbsoluteError(testing::Estimate(fly(seed))) / kFlights;
  }
  return sum;
}

TEST(EstimatorRig, ACameraThatLooksBackHelps) {
  const double front = MeanRigError(&FrontFlight);
  const double both =
      MeanRigError([](uint64_t seed) { return WithBackCamera(FrontFlight(seed), seed); });
  EXPECT_LT(both, front);
}

TEST(EstimatorRig, CarriesOnWhileTheFirstCameraIsBlind) {
  const double front =
      MeanRigError([](uint64_t seed) { return WithBlindFront(FrontFlight(seed)); });
  const double both = MeanRigError(
      [](uint64_t seed) { return WithBlindFront(WithBackCamera(FrontFlight(seed), seed)); });
  EXPECT_LT(both, 0.8 * front);
}

TEST(EstimatorRig, StartsByTheCameraThatSees) {
  SimulatedFlight flight = WithBackCamera(FrontFlight(1), 1);
  for (FrameMeasurement& frame : flight.frames) {
    std::vector<PointObservation>& points = frame.points.points;
    points.erase(points.begin(),
                 std::find_if(points.begin(), points.end(),
                              [](const PointObservation& point) { return point.camera == 1; }));
  }
  const EstimatedFlight estimated = testing::Estimate(flight);
  ASSERT_FALSE(estimated.outputs.empty());
  EXPECT_LT(testing::AbsoluteError(estimated), 0.05);
}

// Starts with 0.3 degrees of error, of which a third may be left after 15 s.
TEST(EstimatorRig, FindsTheExtrinsicsOfEachCamera) {
  SimulatedFlight flight = WithBackCamera(FrontFlight(1), 1);
  const Rigid3d truth = flight.sensor.cameras[0].T_B_C.Inverse() * flight.sensor.cameras[1].T_B_C;
  Rigid3d& configured = flight.sensor.cameras[1].T_B_C;
  const Vector3d axis = Vector3d(1, -1, 1).normalized();
  configured.rotation = configured.rotation * SO3Exp(0.3 * M_PI / 180 * axis);
  configured.translation += 0.005 * Vector3d(-1, 1, 1).normalized();
  const EstimatedFlight estimated = testing::Estimate(flight);
  ASSERT_FALSE(estimated.outputs.empty());
  const auto& cameras = estimated.outputs.back().calibration.cameras;
  const Rigid3d found = cameras[0].T_B_C.Inverse() * cameras[1].T_B_C;
  EXPECT_LT(SO3Log(truth.rotation.conjugate() * found.rotation).norm(), 0.1 * M_PI / 180);
}

}  // namespace
}  // namespace plm_vins
