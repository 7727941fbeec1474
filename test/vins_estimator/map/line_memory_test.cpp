// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_memory.h"

#include <gtest/gtest.h>

#include <vector>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;

// A line along x at a height, from `start` to `end`.
SeenLine LineAlongX(double start, double end, double height = 0, double sigma = 0.02) {
  SeenLine line;
  line.start_F = {start, 0, height};
  line.end_F = {end, 0, height};
  line.place_sigma = sigma;
  return line;
}

LineLandmark::Observation SeenAt(int64_t t_ns) {
  LineLandmark::Observation observation;
  observation.t_ns = t_ns;
  return observation;
}

std::vector<int64_t> StampsOf(const RememberedLine& line) {
  std::vector<int64_t> stamps;
  for (const LineLandmark::Observation& observation : line.anchor_observations)
    stamps.push_back(observation.t_ns);
  return stamps;
}

using StampList = std::vector<int64_t>;

class LineMemoryTest : public ::testing::Test {
 protected:
  void ExpectSeen(int64_t id, const Vector3d& start, const Vector3d& end) const {
    const RememberedLine* line = memory_.Find(id);
    ASSERT_NE(line, nullptr);
    EXPECT_MATRIX_NEAR(line->seen_W.start_F, start, 1e-12);
    EXPECT_MATRIX_NEAR(line->seen_W.end_F, end, 1e-12);
  }

  LineMemory memory_;
};

TEST_F(LineMemoryTest, AllowsChangesOfAllAnchorObservations) {
  memory_.Keep(3, LineAlongX(1, 2));
  memory_.Keep(4, LineAlongX(1, 2));
  memory_.KeepObservation(3, SeenAt(10));
  memory_.KeepObservation(3, SeenAt(20));
  memory_.KeepObservation(4, SeenAt(20));
  memory_.ChangeObservations(
      [](LineLandmark::Observation* observation) { observation->segment.end.x() += 2; });
  for (const auto& [id, line] : memory_.lines()) {
    for (const LineLandmark::Observation& observation : line.anchor_observations)
      EXPECT_EQ(observation.segment.end.x(), 2);
  }
}

TEST_F(LineMemoryTest, JoinsObservedParts) {
  memory_.Keep(3, LineAlongX(1, 2));
  memory_.Keep(3, LineAlongX(1.5, 3));
  ExpectSeen(3, {1, 0, 0}, {3, 0, 0});
  memory_.Keep(3, LineAlongX(2.5, 0));  // reversed
  ExpectSeen(3, {3, 0, 0}, {0, 0, 0});
  memory_.Keep(3, LineAlongX(1, 2));
  ExpectSeen(3, {0, 0, 0}, {3, 0, 0});
}

TEST_F(LineMemoryTest, KeepsTheNewerPosition) {
  memory_.Keep(3, LineAlongX(1, 2, 0, 0.02));
  memory_.Keep(3, LineAlongX(1, 3, 0.1, 0.039));
  ExpectSeen(3, {1, 0, 0.1}, {3, 0, 0.1});
  EXPECT_EQ(memory_.Find(3)->seen_W.place_sigma, 0.039);
}

TEST_F(LineMemoryTest, KeepsTheOlderPositionIfMuchMoreCertain) {
  memory_.Keep(3, LineAlongX(1, 2, 0, 0.02));
  memory_.Keep(3, LineAlongX(1, 3, 0.1, 0.041));
  ExpectSeen(3, {1, 0, 0}, {3, 0, 0});
  EXPECT_EQ(memory_.Find(3)->seen_W.place_sigma, 0.02);
}

TEST_F(LineMemoryTest, KeepsObservationsOfKnownLinesOnly) {
  memory_.KeepObservation(3, SeenAt(10));
  EXPECT_EQ(memory_.Find(3), nullptr);
  memory_.Keep(3, LineAlongX(1, 2));
  memory_.KeepObservation(3, SeenAt(20));
  EXPECT_EQ(StampsOf(*memory_.Find(3)), StampList({20}));
}

TEST_F(LineMemoryTest, KeepsTheFirstAndTheNewestObservation) {
  static_assert(kMaxAnchorObservations == 4);
  memory_.Keep(3, LineAlongX(1, 2));
  for (const int64_t t_ns : {10, 20, 30, 40}) memory_.KeepObservation(3, SeenAt(t_ns));
  EXPECT_EQ(StampsOf(*memory_.Find(3)), StampList({10, 20, 30, 40}));
  for (const int64_t t_ns : {50, 60}) memory_.KeepObservation(3, SeenAt(t_ns));
  EXPECT_EQ(StampsOf(*memory_.Find(3)), StampList({10, 40, 50, 60}));
}

TEST_F(LineMemoryTest, UpdateOfALineKeepsItsObservations) {
  memory_.Keep(3, LineAlongX(1, 2));
  memory_.KeepObservation(3, SeenAt(10));
  memory_.Keep(3, LineAlongX(1, 3));
  EXPECT_EQ(StampsOf(*memory_.Find(3)), StampList({10}));
}

TEST_F(LineMemoryTest, JoinedLinesAreOne) {
  memory_.Keep(3, LineAlongX(1, 2));
  memory_.KeepObservation(3, SeenAt(10));
  memory_.Keep(7, LineAlongX(2, 4));
  memory_.KeepObservation(7, SeenAt(20));
  memory_.Join(7, 3);
  EXPECT_EQ(memory_.Find(7), nullptr);
  ExpectSeen(3, {1, 0, 0}, {4, 0, 0});
  EXPECT_EQ(StampsOf(*memory_.Find(3)), StampList({10, 20}));
}

TEST_F(LineMemoryTest, JoinAddsMissingObservations) {
  memory_.Keep(7, LineAlongX(2, 4));
  memory_.KeepObservation(7, SeenAt(20));
  memory_.Join(7, 3);
  ExpectSeen(3, {2, 0, 0}, {4, 0, 0});
  EXPECT_EQ(StampsOf(*memory_.Find(3)), StampList({20}));
}

TEST_F(LineMemoryTest, JoinOfAnUnknownLineChangesNothing) {
  memory_.Keep(3, LineAlongX(1, 2));
  memory_.Join(7, 3);
  memory_.Join(8, 9);
  EXPECT_EQ(memory_.lines().size(), 1u);
  ExpectSeen(3, {1, 0, 0}, {2, 0, 0});
}

TEST_F(LineMemoryTest, RemovesObservationsOfARemovedAnchor) {
  for (const int64_t id : {3, 7}) {
    memory_.Keep(id, LineAlongX(1, 2));
    for (const int64_t t_ns : {10, 20}) memory_.KeepObservation(id, SeenAt(t_ns));
  }
  memory_.RemoveAnchor(10);
  memory_.RemoveAnchor(99);
  for (const int64_t id : {3, 7}) EXPECT_EQ(StampsOf(*memory_.Find(id)), StampList({20}));
}

TEST_F(LineMemoryTest, EvictsTheLeastRecentlyUpdatedLine) {
  const auto capacity = static_cast<int64_t>(LineMemory::kCapacity);
  for (int64_t id = 0; id < capacity; ++id) memory_.Keep(id, LineAlongX(1, 2));
  memory_.Keep(0, LineAlongX(1, 3));
  EXPECT_EQ(memory_.lines().size(), LineMemory::kCapacity);
  memory_.Keep(capacity, LineAlongX(4, 5));
  EXPECT_EQ(memory_.lines().size(), LineMemory::kCapacity);
  EXPECT_EQ(memory_.Find(1), nullptr);
  ExpectSeen(0, {1, 0, 0}, {3, 0, 0});
  ExpectSeen(capacity, {4, 0, 0}, {5, 0, 0});
}

}  // namespace
}  // namespace plm_vins
