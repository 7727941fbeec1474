// SPDX-License-Identifier: BSD-3-Clause
#include "mavros_relay/relay_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace plm_vins {
namespace {

constexpr int64_t kMillisecond = 1'000'000;  // [ns]
constexpr int64_t kStart = 1403636579'000 * kMillisecond;

// Passes states every 5 ms and estimates of images every 50 ms.
class Feed {
 public:
  explicit Feed(double rate = 30) : gate(rate) {}

  // Returns the relayed timestamps in [begin, end) [ms since the start].
  std::vector<int64_t> Send(int64_t begin, int64_t end, bool with_images = true) {
    std::vector<int64_t> passed;
    for (int64_t t = begin; t < end; t += 5) {
      if (with_images && t % 50 == 0) gate.AddImage();
      if (gate.Pass(kStart + t * kMillisecond)) passed.push_back(t);
    }
    return passed;
  }

  RelayGate gate;
};

TEST(RelayGate, KeepsTheMeanRate) {
  for (const double rate : {1.0, 30.0, 45.0, 200.0, 1000.0}) {
    Feed feed(rate);
    feed.Send(-50, 0);  // supported from the next image on
    EXPECT_NEAR(static_cast<double>(feed.Send(0, 10'000).size()), 10 * std::min(rate, 200.0), 1)
        << rate;
    EXPECT_EQ(feed.gate.resets(), 0);
  }
}

// A period that overflows int64 nanoseconds would otherwise abort the program.
TEST(RelayGate, RejectsRatesOutOfRange) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double rate : {kInfinity, kNan, 3e9, 1e-12, 0.0, -1.0}) {
    EXPECT_THROW(RelayGate{rate}, std::invalid_argument) << rate;
  }
}

TEST(RelayGate, WaitsForTheFirstImage) {
  Feed feed;
  EXPECT_TRUE(feed.Send(0, 1000, false).empty());
  EXPECT_TRUE(feed.gate.is_interrupted());
  EXPECT_EQ(feed.Send(1000, 2000).front(), 1000);
  EXPECT_FALSE(feed.gate.is_interrupted());
  EXPECT_EQ(feed.gate.resets(), 0);
}

TEST(RelayGate, StopsWithoutRecentImages) {
  Feed feed;
  feed.Send(0, 1000);
  const std::vector<int64_t> passed = feed.Send(1000, 5000, false);
  EXPECT_NEAR(static_cast<double>(passed.back()), 950 + 500, 35);
  EXPECT_TRUE(feed.gate.is_interrupted());
  EXPECT_EQ(feed.Send(5000, 6000).front(), 5000);
  EXPECT_EQ(feed.gate.resets(), 1);
}

TEST(RelayGate, GapsLastLongEnoughForMavros) {
  Feed feed;
  const int64_t last = feed.Send(0, 1000).back();
  // The estimator is reinitialized within 0.3 s.
  EXPECT_EQ(feed.Send(1300, 3000).front(), last + 1000);
  EXPECT_EQ(feed.gate.resets(), 1);
}

// Neither states nor images come while an estimator has lost tracking.
TEST(RelayGate, PausedInputCountsAsReset) {
  Feed feed;
  feed.Send(0, 1000);
  EXPECT_EQ(feed.Send(3000, 4000).front(), 3050) << "an image supports nothing that came after it";
  EXPECT_EQ(feed.gate.resets(), 1);
}

TEST(RelayGate, LostStatesAreNotAGap) {
  Feed feed;
  feed.Send(0, 1000);
  EXPECT_LE(feed.Send(1150, 2000).front(), 1150);
  EXPECT_EQ(feed.gate.resets(), 0);
}

TEST(RelayGate, RestartsAfterTimestampsJumpBack) {
  Feed feed;
  feed.Send(10'000, 11'000);
  EXPECT_EQ(feed.Send(0, 1000).front(), 50) << "with the next image";
  EXPECT_EQ(feed.gate.resets(), 1);
}

}  // namespace
}  // namespace plm_vins
