// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <thread>
#include <utility>

#include "common/streams/bounded_queue.h"

namespace plm_vins {

// Receives items one by one; returns false if no more are wanted.
template <typename Item>
using ItemReceiver = std::function<bool(Item)>;

// Runs `produce` in a separate thread, up to `capacity` items ahead of `consume`, which receives
// the same items in the same order in the caller's thread. An exception of `produce` is rethrown to
// the caller after all previous items; one of `consume`, after `produce` has ended.
template <typename Item>
void RunAhead(size_t capacity, const std::function<void(const ItemReceiver<Item>&)>& produce,
              const ItemReceiver<Item>& consume) {
  BoundedQueue<Item> queue(capacity);
  std::exception_ptr producer_error;
  std::thread producer([&] {
    try {
      produce([&](Item item) { return queue.Push(std::move(item)); });
    } catch (...) {
      producer_error = std::current_exception();
    }
    queue.Close();
  });
  std::exception_ptr consumer_error;
  try {
    bool goes_on = true;
    while (goes_on) {
      auto item = queue.Pop();
      goes_on = item && consume(std::move(*item));
    }
  } catch (...) {
    consumer_error = std::current_exception();
  }
  queue.Close();
  producer.join();
  if (producer_error) std::rethrow_exception(producer_error);
  if (consumer_error) std::rethrow_exception(consumer_error);
}

}  // namespace plm_vins
