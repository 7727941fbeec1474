// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/run_ahead.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace plm_vins {
namespace {

constexpr size_t kCapacity = 5;
constexpr int kItems = 1000;

void CountUp(const ItemReceiver<int>& emit) {
  for (int i = 0; i < kItems; ++i) {
    if (!emit(i)) return;
  }
}

TEST(RunAhead, DeliversAllItemsInOrder) {
  std::vector<int> received;
  RunAhead<int>(kCapacity, CountUp, [&](int item) {
    received.push_back(item);
    return true;
  });
  ASSERT_EQ(received.size(), static_cast<size_t>(kItems));
  for (int i = 0; i < kItems; ++i) EXPECT_EQ(received[i], i);
}

TEST(RunAhead, ProducesInAnotherThreadAndConsumesInThisOne) {
  std::thread::id producer, consumer;
  RunAhead<int>(
      kCapacity,
      [&](const ItemReceiver<int>& emit) {
        producer = std::this_thread::get_id();
        emit(1);
      },
      [&](int) {
        consumer = std::this_thread::get_id();
        return true;
      });
  EXPECT_NE(producer, std::this_thread::get_id());
  EXPECT_EQ(consumer, std::this_thread::get_id());
}

TEST(RunAhead, RunsAheadByAtMostTheLimit) {
  std::atomic<int> produced = 0;
  int consumed = 0;
  RunAhead<int>(
      kCapacity,
      [&](const ItemReceiver<int>& emit) {
        for (; produced < kItems; ++produced) emit(produced);
      },
      [&](int) {
        // The consumer holds one more item.
        EXPECT_LE(produced - consumed, static_cast<int>(kCapacity) + 1);
        ++consumed;
        return true;
      });
  EXPECT_EQ(consumed, kItems);
}

TEST(RunAhead, StopsTheProducerOnRequest) {
  bool was_told = false;
  int consumed = 0;
  RunAhead<int>(
      kCapacity,
      [&](const ItemReceiver<int>& emit) {
        while (emit(0)) continue;
        was_told = true;
      },
      [&](int) { return ++consumed < 3; });
  EXPECT_TRUE(was_told);
  EXPECT_EQ(consumed, 3);
}

TEST(RunAhead, PropagatesExceptionsOfTheProducerAfterItsItems) {
  int consumed = 0;
  EXPECT_THROW(RunAhead<int>(
                   kCapacity,
                   [](const ItemReceiver<int>& emit) {
                     CountUp(emit);
                     throw std::runtime_error("disk error");
                   },
                   [&](int) {
                     ++consumed;
                     return true;
                   }),
               std::runtime_error);
  EXPECT_EQ(consumed, kItems);
}

TEST(RunAhead, PropagatesExceptionsOfTheConsumer) {
  EXPECT_THROW(
      RunAhead<int>(kCapacity, CountUp, [](int) -> bool { throw std::runtime_error("disk full"); }),
      std::runtime_error);
}

}  // namespace
}  // namespace plm_vins
