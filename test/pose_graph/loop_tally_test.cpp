// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/loop_tally.h"

#include <gtest/gtest.h>

#include <vector>

namespace plm_vins {
namespace {

LoopCandidate RefusedBy(LoopGate gate) {
  LoopCandidate loop;
  loop.failed = gate;
  return loop;
}

LoopTally TallyOf(const std::vector<LoopClosure>& closures) {
  LoopTally tally;
  for (const LoopClosure& closure : closures) tally.Add(closure);
  return tally;
}

TEST(LoopTallyTest, CountsEachVerdict) {
  LoopClosure closure;
  closure.candidates = {RefusedBy(LoopGate::kScore), LoopCandidate(), RefusedBy(LoopGate::kScore)};
  closure.dropped = {LevelEdge()};
  LoopTally tally = TallyOf({closure});
  EXPECT_EQ(tally.candidates, 3);
  EXPECT_EQ(tally.accepted, 1);
  EXPECT_EQ(tally.dropped, 1);
  EXPECT_EQ(tally.refused.size(), 1);
  EXPECT_EQ(tally.refused[LoopGate::kScore], 2);
}

TEST(LoopTallyTest, CountsADelayedLoopOnce) {
  LoopClosure first, second;
  first.candidates = {RefusedBy(LoopGate::kAgreement), RefusedBy(LoopGate::kAgreement)};
  second.candidates = {LoopCandidate()};
  second.confirmed = {LoopCandidate()};  // one of the first closure
  LoopTally tally = TallyOf({first, second});
  EXPECT_EQ(tally.candidates, 3);
  EXPECT_EQ(tally.accepted, 2);
  EXPECT_EQ(tally.refused[LoopGate::kAgreement], 1);
}

TEST(LoopTallyTest, CountsALoopThatTheGraphRejectsUnderItsLastGate) {
  LoopClosure first, second;
  first.candidates = {RefusedBy(LoopGate::kAgreement)};
  second.confirmed = {RefusedBy(LoopGate::kGraph)};
  LoopTally tally = TallyOf({first, second});
  EXPECT_EQ(tally.accepted, 0);
  EXPECT_EQ(tally.refused[LoopGate::kAgreement], 0);
  EXPECT_EQ(tally.refused[LoopGate::kGraph], 1);
}

TEST(LoopTallyTest, CountsALoopThatTheGraphAcceptsLaterOnce) {
  LoopClosure first, second;
  first.candidates = {RefusedBy(LoopGate::kGraph), RefusedBy(LoopGate::kGraph)};
  second.candidates = {RefusedBy(LoopGate::kGraph)};
  second.reconsidered = {LoopCandidate(), LoopCandidate()};  // the newest, one of the first
  LoopTally tally = TallyOf({first, second});
  EXPECT_EQ(tally.candidates, 3);
  EXPECT_EQ(tally.accepted, 2);
  EXPECT_EQ(tally.refused[LoopGate::kAgreement], 0);
  EXPECT_EQ(tally.refused[LoopGate::kGraph], 1);
}

}  // namespace
}  // namespace plm_vins
