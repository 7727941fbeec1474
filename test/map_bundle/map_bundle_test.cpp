// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/map_bundle.h"

#include <gtest/gtest.h>

#include <limits>

#include "test/map_bundle/drifting_flight.h"

namespace plm_vins {
namespace {

using testing::DriftingFlight;
using testing::DriftingFlightOptions;
using testing::PositionError;

double ErrorOf(const DriftingFlight& flight, const AdjustedMap& adjusted) {
  return PositionError(flight, [&](int number) { return adjusted.T_M_B.at(number); });
}

double ErrorOfOdometry(const DriftingFlight& flight) {
  return PositionError(flight, [&](int number) { return flight.InMap(number); });
}

// A bundle that knows a flight.
struct ToldBundle : MapBundle {
  explicit ToldBundle(const DriftingFlight& flight, const MapBundleOptions& options = {})
      : MapBundle(options) {
    flight.Tell(this);
  }
};

// Error after the adjustment of such a flight [m]; infinite if it is not adjusted.
double ErrorAfterAdjustment(const DriftingFlightOptions& options) {
  const DriftingFlight flight(options);
  const auto adjusted = ToldBundle(flight).Adjust(flight.map());
  return adjusted ? ErrorOf(flight, *adjusted) : std::numeric_limits<double>::infinity();
}

TEST(MapBundleTest, RemovesDriftAndScaleError) {
  const DriftingFlight flight(DriftingFlightOptions{});
  ToldBundle bundle(flight);

  EXPECT_EQ(bundle.KeyframesToAdjust(flight.map()), flight.map().keyframes.size());
  const auto adjusted = bundle.Adjust(flight.map());

  ASSERT_TRUE(adjusted);
  EXPECT_EQ(adjusted->T_M_B.size(), flight.map().keyframes.size());
  EXPECT_GT(ErrorOfOdometry(flight), 0.1);
  EXPECT_LT(ErrorOf(flight, *adjusted), 0.015);
  EXPECT_GT(bundle.summary().reobservations, 400u);
}

TEST(MapBundleTest, EstimatesTheObservationNoise) {
  DriftingFlightOptions options;
  options.noise = 3e-3;
  const DriftingFlight flight(options);
  ToldBundle bundle(flight);

  ASSERT_TRUE(bundle.Adjust(flight.map()));

  EXPECT_NEAR(bundle.summary().noise.followed, 3e-3, 3e-4);
  EXPECT_NEAR(bundle.summary().noise.again, 3e-3, 1e-3);
}

TEST(MapBundleTest, ASecondCameraTellsTheScale) {
  double one = 0, two = 0;
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    DriftingFlightOptions options;
    options.seed = seed;
    one += ErrorAfterAdjustment(options);
    options.stereo = true;
    two += ErrorAfterAdjustment(options);
  }
  EXPECT_LT(two, 0.9 * one);
}

TEST(MapBundleTest, ToleratesWrongMatchesDistantLandmarksClocksAndRestarts) {
  DriftingFlightOptions wrong, distant, clock, restart;
  wrong.wrong_share = 0.2;
  distant.far_points = 5;
  clock.camera_clock = 0.2;
  restart.restart = 20;  // timestamps repeat, as when a bag is replayed
  EXPECT_LT(ErrorAfterAdjustment(wrong), 0.03);
  for (const DriftingFlightOptions& options : {distant, clock, restart}) {
    EXPECT_LT(ErrorAfterAdjustment(options), 0.015)
        << options.far_points << ", " << options.camera_clock << ", " << options.restart;
  }
}

// Keyframes of a loaded map may have another T_B_C, here by 0.3 m. 25 flights have errors of 0.03
// to 0.08 m.
TEST(MapBundleTest, DoesNotMoveCamerasOfALoadedMap) {
  DriftingFlightOptions options;
  options.drift = 0;
  options.scale = 1;
  options.loaded = 20;
  const DriftingFlight flight(options);
  ToldBundle bundle(flight);

  const auto adjusted = bundle.Adjust(flight.map());

  ASSERT_TRUE(adjusted);
  EXPECT_EQ(adjusted->T_M_B.begin()->first, options.loaded);
  const Rigid3d T_W_M = flight.True(0) * flight.InMap(0).Inverse();
  for (const auto& [number, T_M_B] : adjusted->T_M_B) {
    const Eigen::Vector3d p_W = T_W_M * T_M_B.translation;
    EXPECT_LT((p_W - flight.True(number).translation).norm(), 0.1) << number;
  }
}

TEST(MapBundleTest, NeedsLoops) {
  const DriftingFlight flight(DriftingFlightOptions{});
  MapBundleOptions options;
  options.min_places = 1000;
  ToldBundle bundle(flight, options);

  EXPECT_EQ(bundle.KeyframesToAdjust(flight.map()), 0u);
  EXPECT_FALSE(bundle.Adjust(flight.map()));
  EXPECT_FALSE(bundle.summary().failed);
}

TEST(MapBundleTest, IgnoresLoopsThatTheGraphRejects) {
  DriftingFlightOptions options;
  options.refused = true;
  const DriftingFlight flight(options);
  ToldBundle bundle(flight);
  EXPECT_FALSE(bundle.Adjust(flight.map()));

  LoopClosure later;
  for (const auto& [number, place] : flight.places()) {
    LoopCandidate& loop = later.reconsidered.emplace_back();
    loop.earlier = place.earlier;
    loop.later = number;
  }
  bundle.AddLoops(flight.map(), later);
  EXPECT_TRUE(bundle.Adjust(flight.map()));
}

TEST(MapBundleTest, IgnoresLoopsThatTheGraphDropsLater) {
  const DriftingFlight flight(DriftingFlightOptions{});
  ToldBundle bundle(flight);
  EXPECT_TRUE(bundle.Adjust(flight.map()));

  LoopClosure later;
  for (const auto& [number, place] : flight.places()) {
    LevelEdge& edge = later.dropped.emplace_back();
    edge.from = place.earlier;
    edge.to = number;
  }
  bundle.AddLoops(flight.map(), later);
  EXPECT_FALSE(bundle.Adjust(flight.map()));
}

TEST(MapBundleTest, KeepsCompletedRoundsWhenStopped) {
  const DriftingFlight flight(DriftingFlightOptions{});
  ToldBundle bundle(flight);

  EXPECT_FALSE(bundle.Adjust(flight.map(), [] { return true; }));
  EXPECT_TRUE(bundle.summary().ended);

  int asked = 0;
  const auto adjusted = bundle.Adjust(flight.map(), [&asked] { return ++asked > 1; });
  ASSERT_TRUE(adjusted);
  EXPECT_TRUE(bundle.summary().ended);
  EXPECT_EQ(bundle.summary().rounds, 1);
  EXPECT_LT(ErrorOf(flight, *adjusted), 0.03);

  ASSERT_TRUE(bundle.Adjust(flight.map()));
  EXPECT_FALSE(bundle.summary().ended);
  EXPECT_EQ(bundle.summary().rounds, 3);
}

TEST(MapBundleTest, ReportsSingularEquations) {
  DriftingFlightOptions options;
  options.scale = std::numeric_limits<double>::quiet_NaN();
  const DriftingFlight flight(options);
  ToldBundle bundle(flight);

  EXPECT_FALSE(bundle.Adjust(flight.map()));

  EXPECT_TRUE(bundle.summary().failed);
  EXPECT_EQ(bundle.summary().rounds, 0);
}

TEST(MapBundleTest, CountsUsedObservations) {
  DriftingFlightOptions options;
  options.keyframes_of_visit = 5;
  const DriftingFlight flight(options);
  ToldBundle bundle(flight);
  size_t told = 0;
  for (const auto& [number, place] : flight.places()) told += place.observations.of_earlier.size();

  ASSERT_TRUE(bundle.Adjust(flight.map()));

  EXPECT_GT(bundle.summary().reobservations, told / 10);
  EXPECT_LT(bundle.summary().reobservations, told);  // some landmarks were observed only once
}

TEST(MapBundleTest, AcceptsAnEmptyMap) {
  MapBundle bundle(MapBundleOptions{});
  EXPECT_FALSE(bundle.Adjust(KeyframeMap{}));
}

}  // namespace
}  // namespace plm_vins
