// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/manhattan/heading_votes.h"

#include <gtest/gtest.h>

#include "simulator/random.h"

namespace plm_vins {
namespace {

constexpr double kDegree = M_PI / 180;

TEST(WrapQuarterTurn, KeepsTheAngleModuloNinetyDegrees) {
  EXPECT_NEAR(WrapQuarterTurn(10 * kDegree), 10 * kDegree, 1e-12);
  EXPECT_NEAR(WrapQuarterTurn(100 * kDegree), 10 * kDegree, 1e-12);
  EXPECT_NEAR(WrapQuarterTurn(-80 * kDegree), 10 * kDegree, 1e-12);
  EXPECT_NEAR(WrapQuarterTurn(50 * kDegree), -40 * kDegree, 1e-12);
  EXPECT_NEAR(WrapQuarterTurn(-M_PI), 0, 1e-12);
}

// Tracks `count` lines with directions around `heading` for `duration`, in steps of 0.1 s.
void Poll(HeadingVotes* votes, int first_id, int count, double heading, double spread,
          double duration, uint64_t seed = 1) {
  for (int step = 0; step < duration / 0.1; ++step) {
    simulator::Random random(seed);
    votes->Fade(0.1);
    for (int i = 0; i < count; ++i) {
      votes->Cast(first_id + i, heading + spread * random.Normal(), 0, 0.1);
    }
  }
}

TEST(HeadingVotes, AreEmptyAtFirst) {
  const HeadingSupport support = HeadingVotes().Best();
  EXPECT_EQ(support.total, 0);
  EXPECT_EQ(support.share(), 0);
  EXPECT_GT(support.log_false_alarms, 0);
}

TEST(HeadingVotes, GiveEachLineOneVote) {
  HeadingVotes votes;
  Poll(&votes, 1, 1, 0.1, 0, 10);
  EXPECT_NEAR(votes.Best().total, 1, 1e-9);
  EXPECT_EQ(votes.Best().lines, 1);
}

TEST(HeadingVotes, CountLongFollowedLinesMore) {
  HeadingVotes brief, lasting;
  Poll(&brief, 1, 1, 0.1, 0, 0.2);
  Poll(&lasting, 1, 1, 0.1, 0, 2.0);
  EXPECT_NEAR(brief.Best().total, 0.2 / HeadingVotes::kMaturity, 1e-9);
  EXPECT_NEAR(lasting.Best().total, 1, 1e-9);
}

TEST(HeadingVotes, CountAccurateLinesMore) {
  HeadingVotes votes;
  votes.Cast(1, 0.1, HeadingVotes::kReferenceSigma, 1.0);
  EXPECT_NEAR(votes.Best().total, 0.5, 1e-9);
}

TEST(HeadingVotes, KeepTheMostCertainVoteOfALine) {
  HeadingVotes votes;
  votes.Cast(1, 0.1, kDegree, 1.0);
  votes.Cast(1, 0.2, 3 * kDegree, 1.0);  // restarted
  EXPECT_NEAR(votes.Best().heading, 0.1, 1e-9);
  votes.Cast(1, 0.12, 0.5 * kDegree, 1.0);
  EXPECT_NEAR(votes.Best().heading, 0.12, 1e-9);
}

TEST(HeadingVotes, FadeAndAreForgotten) {
  HeadingVotes votes;
  Poll(&votes, 1, 10, 0.1, 0, 2);
  const double memory = HeadingVotes::kMemory;
  votes.Fade(memory);
  EXPECT_NEAR(votes.Best().total, 10 * std::exp(-1), 1e-6);
  votes.Fade(4 * memory);
  EXPECT_EQ(votes.size(), 0u);
}

TEST(HeadingVotes, MatureAtAnyFrameRate) {
  constexpr double kSigma = 3 * kDegree;
  const double full = 1 / (1 + std::pow(kSigma / HeadingVotes::kReferenceSigma, 2));
  for (const int rate : {10, 20, 30, 60, 200}) {
    HeadingVotes votes;
    for (int image = 0; image < rate; ++image) {
      votes.Fade(1.0 / rate);
      votes.Cast(1, 0.1, kSigma, 1.0 / rate);
    }
    EXPECT_NEAR(votes.Best().total, full, 1e-9) << rate << " Hz";
  }
}

TEST(HeadingVotes, MeetAtTheMeanAcrossTheWrap) {
  HeadingVotes votes;
  Poll(&votes, 1, 30, 45 * kDegree, 0.5 * kDegree, 2);
  const HeadingSupport best = votes.Best();
  EXPECT_NEAR(WrapQuarterTurn(best.heading - 45 * kDegree), 0, 0.3 * kDegree);
  EXPECT_EQ(best.lines, 30);
  EXPECT_NEAR(best.sigma, 0.5 * kDegree / std::sqrt(30), 0.03 * kDegree);
}

TEST(HeadingVotes, PerpendicularLinesShareAHeading) {
  HeadingVotes votes;
  for (int i = 0; i < 20; ++i) votes.Cast(i, 20 * kDegree + i * M_PI / 2, 0, 1.0);
  EXPECT_EQ(votes.Best().lines, 20);
  EXPECT_NEAR(votes.Best().heading, 20 * kDegree, 1e-9);
}

TEST(HeadingVotes, FindTheStrongerOfTwoHeadings) {
  HeadingVotes votes;
  Poll(&votes, 1, 12, 5 * kDegree, 0.5 * kDegree, 2);
  Poll(&votes, 101, 20, 30 * kDegree, 0.5 * kDegree, 2);
  EXPECT_NEAR(votes.Best().heading, 30 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(votes.At(5 * kDegree).heading, 5 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(votes.At(5 * kDegree).share(), 12.0 / 32, 0.05);
}

// The bound holds: among random headings, a false alarm rate below exp(-x) occurs less often than
// exp(-x).
TEST(HeadingVotes, RarelyAcceptChance) {
  simulator::Random random(7);
  constexpr int kPolls = 4000;
  int alarms_at_tenth = 0, alarms_at_hundredth = 0;
  for (int poll = 0; poll < kPolls; ++poll) {
    HeadingVotes votes;
    for (int i = 0; i < 40; ++i) {
      votes.Cast(i, random.Uniform(0, M_PI), 0, random.Uniform(0.1, 2.0));
    }
    const double log_false_alarms = votes.Best().log_false_alarms;
    alarms_at_tenth += log_false_alarms < std::log(0.1);
    alarms_at_hundredth += log_false_alarms < std::log(0.01);
  }
  EXPECT_LT(alarms_at_tenth, 0.1 * kPolls);
  EXPECT_LT(alarms_at_hundredth, 0.01 * kPolls);
}

TEST(HeadingVotes, FindExistingSupport) {
  simulator::Random random(8);
  HeadingVotes votes;
  for (int i = 0; i < 40; ++i) {
    const bool outlier = i % 5 < 2;
    votes.Cast(i, outlier ? random.Uniform(0, M_PI) : 0.2 + 0.01 * random.Normal(), 0, 2.0);
  }
  EXPECT_LT(votes.Best().log_false_alarms, std::log(1e-8));
}

TEST(HeadingVotes, ForgetALineOnRequest) {
  HeadingVotes votes;
  Poll(&votes, 1, 2, 0.1, 0, 2);
  votes.Remove(2);
  EXPECT_EQ(votes.Best().lines, 1);
}

}  // namespace
}  // namespace plm_vins
