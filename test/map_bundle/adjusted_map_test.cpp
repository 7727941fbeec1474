// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/adjusted_map.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "pose_graph/map/map_trajectory.h"
#include "test/map_bundle/drifting_flight.h"

namespace plm_vins {
namespace {

using testing::DriftingFlight;
using testing::DriftingFlightOptions;

// The result of a perfect bundle adjustment.
AdjustedMap TruthOf(const DriftingFlight& flight) {
  AdjustedMap truth;
  truth.T_B_C = flight.map().keyframes.back().T_B_C;
  for (int i = 0; i < flight.map().graph.size(); ++i) truth.T_M_B[i] = flight.True(i);
  return truth;
}

TEST(AdjustedMapTest, MovesNodesToTheirKeyframes) {
  const DriftingFlight flight(DriftingFlightOptions{});
  KeyframeMap map = flight.map();
  MoveNodes(TruthOf(flight), &map);
  for (int i = 0; i < map.graph.size(); ++i) {
    const Keyframe& keyframe = map.keyframes[i];
    EXPECT_EQ(keyframe.T_O_B.translation, flight.map().keyframes[i].T_O_B.translation);
    const Rigid3d T_M_B = PoseInMap(map, {keyframe.t_ns, keyframe.T_O_B, i});
    EXPECT_LT((T_M_B.translation - flight.True(i).translation).norm(), 1e-9) << i;
    EXPECT_LT(T_M_B.rotation.angularDistance(flight.True(i).rotation), 1e-6) << i;
  }
}

TEST(AdjustedMapTest, RebuildsAMapAtAMinimum) {
  const DriftingFlight flight(DriftingFlightOptions{});
  AdjustedMap truth = TruthOf(flight);
  const int64_t track = flight.map().keyframes[3].corners.front().track;
  const Eigen::Vector3d p_M(4, 5, 6);
  truth.p_M[{0, track}] = p_M;
  KeyframeMap moved = flight.map();
  MoveNodes(truth, &moved);

  KeyframeMap rebuilt = RebuiltMap(truth, moved);
  rebuilt.graph.Optimize();

  const LevelTransform T_M_O = rebuilt.T_M_O(0);
  for (int i = 0; i < rebuilt.graph.size(); ++i) {
    const Keyframe& keyframe = rebuilt.keyframes[i];
    EXPECT_LT((rebuilt.T_M_O(i).translation - T_M_O.translation).norm(), 1e-6) << i;
    const Rigid3d T_M_B = rebuilt.T_M_O(i).ToRigid() * keyframe.T_O_B;
    EXPECT_LT((T_M_B.translation - flight.True(i).translation).norm(), 1e-6) << i;
  }
  const DescribedCorner& corner = rebuilt.keyframes[3].corners.front();
  ASSERT_TRUE(corner.p_O);
  EXPECT_LT((rebuilt.T_M_O(3) * corner.p_O->cast<double>() - p_M).norm(), 1e-5);
}

TEST(AdjustedMapTest, UsesTheAdjustedExtrinsics) {
  const DriftingFlight flight(DriftingFlightOptions{});
  AdjustedMap truth = TruthOf(flight);
  truth.T_B_C[0].translation.x() += 0.05;
  KeyframeMap moved = flight.map();
  MoveNodes(truth, &moved);

  const KeyframeMap rebuilt = RebuiltMap(truth, moved);

  for (int i = 0; i < rebuilt.graph.size(); ++i) {
    const Rigid3d T_M_C = flight.True(i) * truth.T_B_C[0];
    EXPECT_LT((rebuilt.T_M_C({i, 0}).translation - T_M_C.translation).norm(), 1e-6) << i;
  }
}

// Keyframes of a loaded map are not adjusted.
TEST(AdjustedMapTest, KeepsUnadjustedKeyframes) {
  const DriftingFlight flight(DriftingFlightOptions{});
  AdjustedMap truth = TruthOf(flight);
  truth.T_B_C[0].translation.x() += 0.05;
  for (int i = 0; i < 10; ++i) truth.T_M_B.erase(i);
  const Eigen::Vector3d p_M(4, 5, 6);
  truth.p_M[{0, flight.map().keyframes[3].corners.front().track}] = p_M;
  KeyframeMap moved = flight.map();
  MoveNodes(truth, &moved);

  const KeyframeMap rebuilt = RebuiltMap(truth, moved);

  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(rebuilt.T_M_C({i, 0}).translation, flight.map().T_M_C({i, 0}).translation) << i;
    EXPECT_EQ(rebuilt.keyframes[i].T_B_C[0].translation,
              flight.map().keyframes[i].T_B_C[0].translation);
  }
  const DescribedCorner& corner = rebuilt.keyframes[3].corners.front();
  EXPECT_LT((rebuilt.T_M_O(3) * corner.p_O->cast<double>() - p_M).norm(), 1e-5);
}

TEST(AdjustedMapTest, KeepsTheNumbersOfKeyframes) {
  const DriftingFlight flight(DriftingFlightOptions{});
  AdjustedMap truth = TruthOf(flight);
  KeyframeMap moved = flight.map();
  moved.Remove(2, 3);
  truth.T_M_B.erase(2);
  MoveNodes(truth, &moved);

  const KeyframeMap rebuilt = RebuiltMap(truth, moved);

  EXPECT_EQ(rebuilt.NumbersInMap(), moved.NumbersInMap());
  EXPECT_EQ(rebuilt.keyframes[5].t_ns, moved.keyframes[5].t_ns);
}

}  // namespace
}  // namespace plm_vins
