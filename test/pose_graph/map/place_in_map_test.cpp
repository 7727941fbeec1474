// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/place_in_map.h"

#include <gtest/gtest.h>

#include <random>

namespace plm_vins {
namespace {

OdometryNoise NoFloor() {
  OdometryNoise noise;
  noise.position_floor = noise.position_rate = noise.yaw_floor = noise.yaw_rate = 0;
  return noise;
}

Matrix4d Variance(double position) {
  return Vector4d(position, position, position, 0).asDiagonal();
}

LevelEdge Loop(int from, int to, double variance) {
  LevelEdge loop;
  loop.from = from;
  loop.to = to;
  loop.covariance = Variance(variance);
  loop.is_loop = true;
  return loop;
}

class PlaceInMapTest : public ::testing::Test {
 protected:
  // Adds a keyframe at the origin with this variance of each coordinate.
  void Add(int world, double variance) {
    Keyframe& keyframe = map_.keyframes.emplace_back();
    keyframe.world = world;
    keyframe.covariance = Variance(variance);
    map_.graph.AddNode({});
    place_.AddKeyframe(map_);
  }

  // Adds a loop to the graph as well.
  void AddToGraph(const LevelEdge& loop) {
    map_.graph.AddEdge(loop);
    place_.AddLoop(map_, loop);
  }

  // Variance of each coordinate in the map for a current pose with `variance` in odometry.
  double VarianceInMap(double variance) const {
    return LevelCovarianceInMap(place_.Fix(map_), Eigen::Vector3d::Zero(), Variance(variance))(0,
                                                                                               0);
  }

  KeyframeMap map_;
  PlaceInMap place_{NoFloor()};
};

TEST_F(PlaceInMapTest, HasTheCovarianceOfOdometryWithoutLoops) {
  for (const double variance : {0.1, 0.2, 0.3}) Add(0, variance);
  EXPECT_NEAR(VarianceInMap(0.4), 0.4, 1e-12);
}

TEST_F(PlaceInMapTest, AddsOdometrySinceTheLastLoop) {
  for (const double variance : {0.1, 0.2, 0.9}) Add(0, variance);
  place_.AddLoop(map_, Loop(0, 2, 0.05));
  EXPECT_NEAR(VarianceInMap(0.9), 0.1 + 0.05, 1e-12);
  EXPECT_NEAR(VarianceInMap(1.2), 0.1 + 0.05 + 0.3, 1e-12);
  Add(0, 1.0);
  place_.AddLoop(map_, Loop(2, 3, 0.01));
  EXPECT_NEAR(VarianceInMap(1.0), 0.1 + 0.05 + 0.01, 1e-12);
}

TEST_F(PlaceInMapTest, LessCertainLoopDoesNotChangeIt) {
  for (const double variance : {0.1, 0.2}) Add(0, variance);
  place_.AddLoop(map_, Loop(0, 1, 0.5));
  EXPECT_NEAR(VarianceInMap(0.2), 0.2, 1e-12);
}

// The covariance of odometry refers to an origin that is unrelated to the map's.
TEST_F(PlaceInMapTest, LocatesANewWorldByItsLoop) {
  Add(0, 0.1);
  for (const double variance : {0.01, 0.02, 0.04}) Add(1, variance);
  place_.AddLoop(map_, Loop(0, 2, 0.5));
  EXPECT_NEAR(VarianceInMap(0.04), 0.1 + 0.5 + 0.02, 1e-12);
  place_.AddLoop(map_, Loop(1, 3, 0.001));  // also improves its earlier keyframes
  EXPECT_NEAR(VarianceInMap(0.04), 0.1 + 0.5 + 0.01 + 0.001, 1e-12);
}

TEST_F(PlaceInMapTest, IgnoresDroppedLoops) {
  for (const double variance : {0.1, 0.2}) Add(0, variance);
  AddToGraph(Loop(0, 1, 0.02));
  Add(0, 0.9);
  EXPECT_NEAR(VarianceInMap(0.9), 0.1 + 0.02 + 0.7, 1e-12);
  place_.AddLoop(map_, Loop(0, 2, 0.05));
  Add(0, 1.0);
  EXPECT_NEAR(VarianceInMap(1.0), 0.1 + 0.05 + 0.1, 1e-12);
  place_.Recompute(map_);
  EXPECT_NEAR(VarianceInMap(1.0), 0.1 + 0.02 + 0.8, 1e-12);
}

TEST_F(PlaceInMapTest, RemainingLoopsKeepTheirEffect) {
  Add(0, 0.1);
  for (const double variance : {0.01, 0.02, 0.04}) Add(1, variance);
  AddToGraph(Loop(0, 3, 0.5));
  Add(1, 0.07);
  AddToGraph(Reversed(Loop(1, 4, 0.001)));
  for (const double variance : {0.3, 0.5}) Add(2, variance);
  AddToGraph(Loop(3, 6, 0.2));
  const double before = VarianceInMap(0.6);
  place_.Recompute(map_);
  EXPECT_NEAR(VarianceInMap(0.6), before, 1e-12);
}

TEST_F(PlaceInMapTest, LoadedMapStaysExactWithoutLoops) {
  map_.keyframes.emplace_back().covariance = Variance(7);
  map_.graph.AddNode({});
  place_.SetMap(map_);
  for (const double variance : {0.01, 0.03}) Add(1, variance);
  AddToGraph(Loop(0, 1, 0.2));
  place_.AddLoop(map_, Loop(0, 2, 0.1));
  place_.Recompute(map_);
  EXPECT_NEAR(VarianceInMap(0.03), 0.2 + 0.02, 1e-12);
}

// The covariance of the other world refers to its own origin, not the map's.
TEST_F(PlaceInMapTest, LocatesAWorldByTheNewestLoop) {
  Add(0, 0.1);
  for (const double variance : {0.01, 0.02}) Add(1, variance);
  for (const double variance : {0.3, 0.4}) Add(2, variance);
  AddToGraph(Loop(0, 3, 0.05));
  AddToGraph(Loop(1, 4, 0.001));
  EXPECT_NEAR(VarianceInMap(0.4), 0.1 + 0.05 + 0.1, 1e-12);
  Add(2, 0.9);
  AddToGraph(Loop(2, 5, 0.001));
  const double of_keyframe_2 = 0.25 + 0.001 + 0.01;
  EXPECT_NEAR(VarianceInMap(0.9), of_keyframe_2 + 0.001, 1e-12);
  place_.Recompute(map_);
  EXPECT_NEAR(VarianceInMap(0.9), of_keyframe_2 + 0.001, 1e-12);
}

TEST_F(PlaceInMapTest, LocatesJoinedWorldsByTheLoopToTheMap) {
  Add(0, 0.1);
  for (const double variance : {0.01, 0.02}) Add(1, variance);
  for (const double variance : {0.3, 0.4}) Add(2, variance);
  AddToGraph(Loop(1, 3, 0.05));  // neither is connected with the map
  AddToGraph(Loop(0, 4, 0.5));
  EXPECT_NEAR(VarianceInMap(0.4), 0.1 + 0.5, 1e-12);
  Add(2, 0.9);
  AddToGraph(Loop(1, 5, 0.001));  // known through keyframe 3
  EXPECT_NEAR(VarianceInMap(0.9), 0.6 + (0.1 + 0.05) + 0.001, 1e-12);
}

TEST_F(PlaceInMapTest, UnconnectedWorldOfALoadedMapIsNotExact) {
  for (const int world : {0, 1, 1}) {
    Keyframe& keyframe = map_.keyframes.emplace_back();
    keyframe.world = world;
    keyframe.covariance = Variance(map_.graph.AddNode({}));
  }
  LevelEdge step;
  step.from = 1;
  step.to = 2;
  map_.graph.AddEdge(step);
  place_.SetMap(map_);
  for (const double variance : {0.01, 0.04}) Add(2, variance);
  AddToGraph(Loop(0, 3, 0.2));
  AddToGraph(Loop(1, 4, 0.001));
  EXPECT_NEAR(VarianceInMap(0.04), 0.2 + 0.03, 1e-12);
  Add(2, 4.0);
  AddToGraph(Loop(2, 5, 0.001));
  for (const bool again : {false, true}) {
    if (again) place_.Recompute(map_);
    EXPECT_NEAR(VarianceInMap(4.0), 0.2 + 0.03 + 0.001 + 1 + 0.001, 1e-12);
  }
}

// A path there and back in steps of 0.3 m, each with an error of 0.1 m in each coordinate that
// odometry's covariance contains.
class Way {
 public:
  explicit Way(std::mt19937* random) : random_(random) {
    constexpr int kSteps = 30;
    AddKeyframe();
    for (int i = 0; i < kSteps; ++i) {
      const Eigen::Vector3d step(i < kSteps / 2 ? 0.3 : -0.3, 0, 0);
      truth_ += step;
      p_O_ += step + Error(kStep);
      AddKeyframe();
    }
  }

  // Adds a loop from the first keyframe to the last, with an error of 0.02 m.
  void CloseLoop() {
    LevelEdge loop = Loop(0, Last(), kLoop * kLoop);
    loop.covariance(3, 3) = kSureYaw;
    loop.T_from_to.translation = truth_ + Error(kLoop);
    map_.graph.AddEdge(loop);
    map_.graph.Optimize();
    place_.AddLoop(map_, loop);
  }

  // Squared error of the last position relative to the first keyframe, over its estimated variance.
  double NormalisedSquaredError() const {
    const Eigen::Vector3d error =
        map_.graph.node(Last()).translation - map_.graph.node(0).translation - truth_;
    const Matrix4d stated =
        LevelCovarianceInMap(place_.Fix(map_), p_O_, map_.keyframes.back().covariance);
    return error.squaredNorm() / stated.topLeftCorner<3, 3>().trace();
  }

 private:
  static constexpr double kStep = 0.1, kLoop = 0.02;  // [m]
  static constexpr double kSureYaw = 1e-8;            // [rad^2]

  int Last() const { return map_.graph.size() - 1; }

  Eigen::Vector3d Error(double deviation) {
    std::normal_distribution<double> normal(0, deviation);
    const double x = normal(*random_);
    const double y = normal(*random_);
    return {x, y, normal(*random_)};
  }

  void AddKeyframe() {
    const int number = map_.graph.AddNode({0, p_O_});
    Keyframe& keyframe = map_.keyframes.emplace_back();
    keyframe.T_O_B.translation = p_O_;
    keyframe.covariance = Variance(number * kStep * kStep);
    place_.AddKeyframe(map_);
    if (number == 0) return;
    LevelEdge step;
    step.from = number - 1;
    step.to = number;
    step.T_from_to = map_.keyframes[number - 1].T_O_L().Inverse() * keyframe.T_O_L();
    step.covariance = Variance(kStep * kStep);
    step.covariance(3, 3) = kSureYaw;
    map_.graph.AddEdge(step);
  }

  std::mt19937* random_;
  KeyframeMap map_;
  PlaceInMap place_{NoFloor()};
  Eigen::Vector3d truth_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_O_ = Eigen::Vector3d::Zero();
};

// The graph combines odometry and the loop, which dominates: 0.0004 against 0.3 m^2.
TEST(PlaceInMap, ErrorsMatchTheCovariance) {
  constexpr int kWays = 300;
  std::mt19937 random(5);
  double odometry = 0, map = 0;
  for (int i = 0; i < kWays; ++i) {
    Way way(&random);
    odometry += way.NormalisedSquaredError();
    way.CloseLoop();
    map += way.NormalisedSquaredError();
  }
  EXPECT_NEAR(odometry / kWays, 1, 0.15);  // three standard deviations
  EXPECT_NEAR(map / kWays, 1, 0.15);
}

}  // namespace
}  // namespace plm_vins
