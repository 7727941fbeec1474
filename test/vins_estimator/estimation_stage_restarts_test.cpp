// SPDX-License-Identifier: BSD-3-Clause
// The world frame after failures of the back end: it either continues, or a new one is announced.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {
namespace {

using simulator::FeatureDataset;

constexpr size_t kTroubleImage = 180;  // of 300
constexpr size_t kImuPerImage = 10;
constexpr double kMaxError = 0.3;  // at least three seconds after the trouble [m]
constexpr size_t kScattered = 16;  // images

FeatureDataset GoodFlight() {
  auto options = testing::FlightOptions(simulator::Motion::kFast, 1);
  options.trajectory.duration = 15;
  options.max_points = 80;
  return simulator::SimulateFeatures(options);
}

struct Trouble {
  std::string name;
  void (*damage)(FeatureDataset*);
  std::string restart;  // part of the reason; empty: the world frame goes on
  bool bridged = false;
};

// Moves all points to random positions in several consecutive images.
void ScatterPoints(FeatureDataset* flight) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> anywhere(-0.5, 0.5);
  for (size_t i = kTroubleImage; i < kTroubleImage + kScattered; ++i) {
    for (PointObservation& point : flight->points[i].points) {
      point.xy = {anywhere(random), anywhere(random)};
    }
  }
}

void BreakTracks(FeatureDataset* flight) {
  for (size_t i = kTroubleImage; i < flight->points.size(); ++i) {
    for (PointObservation& point : flight->points[i].points) point.id += 1'000'000;
    for (LineObservation& line : flight->lines[i].lines) line.id += 1'000'000;
  }
}

void Blindfold(FeatureDataset* flight) {
  for (size_t i = kTroubleImage; i < flight->points.size(); ++i) {
    flight->points[i].points.clear();
    flight->lines[i].lines.clear();
  }
}

// Removes all input for four seconds, in which every track ends.
void Pause(FeatureDataset* flight) {
  BreakTracks(flight);
  const auto drop = [](size_t begin, size_t end, auto* stream) {
    stream->erase(stream->begin() + begin, stream->begin() + end);
  };
  drop(kTroubleImage, kTroubleImage + 80, &flight->points);
  drop(kTroubleImage, kTroubleImage + 80, &flight->lines);
  drop(kTroubleImage, kTroubleImage + 80, &flight->truth);
  drop(kTroubleImage * kImuPerImage, (kTroubleImage + 80) * kImuPerImage, &flight->imu);
}

std::vector<Trouble> Troubles() {
  return {
      {"points that jump about", ScatterPoints, "", true},
      {"a point tracker that is started again", BreakTracks, ""},
      {"nothing to be seen", Blindfold, "no feature has constrained the position for"},
      {"a pause of all sensors", Pause, "no feature has constrained the position for"},
  };
}

std::vector<EstimatorOutput> Fly(const FeatureDataset& flight) {
  Config config;
  config.sensor = simulator::FeatureSimulationOptions().sensors;
  config.sensor.imu_noise.accel_density = 0.03;  // strong vibrations, large drift
  config.use_lines = false;
  EstimationStage stage(config);
  std::vector<EstimatorOutput> outputs;
  size_t sample = 0;
  for (size_t i = 0; i < flight.points.size(); ++i) {
    stage.AddPoints(flight.points[i]);
    for (size_t end = (i + 1) * flight.imu.size() / flight.points.size(); sample < end; ++sample) {
      stage.AddImu(flight.imu[sample]);
    }
    while (const auto frame = stage.Pop()) outputs.push_back(frame->output);
  }
  EXPECT_EQ(stage.resets(), std::count_if(outputs.begin(), outputs.end(),
                                          [](const auto& output) { return output.restarted; }));
  return outputs;
}

// Distance of the last position from the truth, with the world frame aligned before the failure.
double ErrorAtTheEnd(const std::vector<EstimatorOutput>& outputs, const FeatureDataset& flight) {
  const Rigid3d T =
      testing::AlignHeading(outputs[kTroubleImage - 1].state, flight.truth[kTroubleImage - 1]);
  const EstimatorOutput& last = outputs.back();
  return (T * Eigen::Vector3d(last.state.position()) - flight.truth[outputs.size() - 1].position())
      .norm();
}

TEST(Restarts, WorldFrameContinuesOrANewOneIsAnnounced) {
  const FeatureDataset good = GoodFlight();
  for (const Trouble& trouble : Troubles()) {
    SCOPED_TRACE(trouble.name);
    FeatureDataset flight = good;
    trouble.damage(&flight);
    std::vector<std::string> reasons;
    bool bridged = false;
    const std::vector<EstimatorOutput> outputs = Fly(flight);
    for (const EstimatorOutput& output : outputs) {
      if (output.restarted) reasons.push_back(output.reason);
      bridged |= output.bridged;
    }
    EXPECT_EQ(bridged, trouble.bridged);
    if (trouble.restart.empty()) {
      EXPECT_TRUE(reasons.empty()) << reasons.front();
      ASSERT_TRUE(outputs.back().has_pose) << outputs.back().reason;
      EXPECT_LT(ErrorAtTheEnd(outputs, flight), kMaxError);
    } else {
      ASSERT_EQ(reasons.size(), 1u);
      EXPECT_NE(reasons[0].find(trouble.restart), std::string::npos) << reasons[0];
    }
  }
}

}  // namespace
}  // namespace plm_vins
