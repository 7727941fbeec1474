// SPDX-License-Identifier: BSD-3-Clause
#include "common/streams/bounded_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

namespace plm_vins {
namespace {

// Waits until another thread blocks.
void LetItWait() { std::this_thread::sleep_for(std::chrono::milliseconds(50)); }

TEST(BoundedQueue, HoldsItemsThatCanOnlyBeMoved) {
  BoundedQueue<std::unique_ptr<int>> queue(1);
  queue.Push(std::make_unique<int>(7));
  EXPECT_EQ(**queue.Pop(), 7);
}

TEST(BoundedQueue, RespectsItsCapacityWithoutLoss) {
  constexpr int kItems = 10000;
  BoundedQueue<int> queue(5);
  std::thread producer([&] {
    for (int i = 0; i < kItems; ++i) queue.Push(i);
    queue.Close();
  });
  int expected = 0;
  while (const auto item = queue.Pop()) {
    EXPECT_EQ(*item, expected++);
    EXPECT_LE(queue.size(), 5u);
  }
  producer.join();
  EXPECT_EQ(expected, kItems);
}

TEST(BoundedQueue, PushOverOldestDropsTheOldest) {
  BoundedQueue<int> queue(2);
  EXPECT_FALSE(queue.PushOverOldest(1));
  EXPECT_FALSE(queue.PushOverOldest(2));
  EXPECT_TRUE(queue.PushOverOldest(3));
  EXPECT_EQ(queue.size(), 2u);
  EXPECT_EQ(queue.Pop(), 2);
  EXPECT_EQ(queue.Pop(), 3);
  queue.Close();
  queue.PushOverOldest(4);
  EXPECT_FALSE(queue.Pop());
}

TEST(BoundedQueue, QuietItemIsPoppedWithTheNext) {
  BoundedQueue<int> queue(3);
  queue.PushQuietly(1);
  queue.Push(2);
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_EQ(queue.Pop(), 2);
}

TEST(BoundedQueue, WakesTheConsumerForAQuietItem) {
  BoundedQueue<int> queue(3);
  std::thread consumer([&] { EXPECT_EQ(queue.Pop(), 1); });
  LetItWait();
  queue.PushQuietly(1);
  queue.Wake();
  consumer.join();
}

TEST(BoundedQueue, QuietItemsWakeTheConsumerOnceTheQueueIsFull) {
  BoundedQueue<int> queue(2);
  std::thread consumer([&] { EXPECT_EQ(queue.Pop(), 1); });
  LetItWait();
  queue.PushQuietly(1);
  queue.PushQuietly(2);
  consumer.join();
}

TEST(BoundedQueue, RejectsAQuietItemWhereItIsFullOrClosed) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.PushQuietly(1));
  EXPECT_TRUE(queue.PushQuietly(2));
  EXPECT_FALSE(queue.PushQuietly(3));
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_TRUE(queue.PushQuietly(4));
  EXPECT_EQ(queue.Pop(), 2);
  queue.Close();
  EXPECT_FALSE(queue.PushQuietly(5));
  EXPECT_EQ(queue.Pop(), 4);
  EXPECT_EQ(queue.Pop(), std::nullopt);
}

TEST(BoundedQueue, DeliversRemainingItemsAfterClosing) {
  BoundedQueue<int> queue(2);
  queue.Push(1);
  queue.Close();
  EXPECT_FALSE(queue.Push(2));
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_EQ(queue.Pop(), std::nullopt);
}

TEST(BoundedQueue, DeliversNothingAfterAbandoning) {
  BoundedQueue<int> queue(2);
  queue.Push(1);
  queue.Abandon();
  EXPECT_FALSE(queue.Push(2));
  EXPECT_EQ(queue.Pop(), std::nullopt);
}

TEST(BoundedQueue, ClosingWakesAProducerThatWaits) {
  BoundedQueue<int> queue(1);
  queue.Push(1);
  std::atomic<bool> accepted = true;
  std::thread producer([&] { accepted = queue.Push(2); });
  LetItWait();
  queue.Close();
  producer.join();
  EXPECT_FALSE(accepted);
}

TEST(BoundedQueue, ClosingWakesAConsumerThatWaits) {
  BoundedQueue<int> queue(1);
  std::thread consumer([&] { EXPECT_EQ(queue.Pop(), std::nullopt); });
  LetItWait();
  queue.Close();
  consumer.join();
}

}  // namespace
}  // namespace plm_vins
