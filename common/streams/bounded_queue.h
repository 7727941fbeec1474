// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace plm_vins {

// Thread-safe FIFO with at most `capacity` items: a full queue blocks the producer, so that nothing
// is lost and memory is bounded. A producer that must not block can drop the oldest item instead
// (PushOverOldest), or the new one (PushQuietly).
template <typename T>
class BoundedQueue {
 public:
  explicit BoundedQueue(size_t capacity) : capacity_(capacity) {}

  // Blocks while the queue is full. Returns false, and drops the item, if the queue is closed.
  bool Push(T item) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || items_.size() < capacity_; });
    if (closed_) return false;
    items_.push_back(std::move(item));
    changed_.notify_all();
    return true;
  }

  // Does not block and wakes no consumer, unless the item fills the queue; Wake() or the next
  // Push() does. Returns false, and drops the item, if the queue is full or closed.
  bool PushQuietly(T item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (closed_ || items_.size() == capacity_) return false;
    items_.push_back(std::move(item));
    if (items_.size() == capacity_) changed_.notify_all();
    return true;
  }
  void Wake() { changed_.notify_all(); }

  // Does not block. Drops the oldest item if the queue is full, and returns whether it did.
  bool PushOverOldest(T item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (closed_) return false;
    const bool is_full = items_.size() == capacity_;
    if (is_full) items_.pop_front();
    items_.push_back(std::move(item));
    changed_.notify_all();
    return is_full;
  }

  // Blocks while the queue is empty. Returns nullopt once the queue is closed and empty.
  std::optional<T> Pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    std::optional<T> item = std::move(items_.front());
    items_.pop_front();
    changed_.notify_all();
    return item;
  }

  // Rejects further items and wakes all waiting threads.
  void Close() {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  // Closes the queue and drops the waiting items.
  void Abandon() {
    const std::lock_guard<std::mutex> lock(mutex_);
    items_.clear();
    closed_ = true;
    changed_.notify_all();
  }

  size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.size();
  }

 private:
  const size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> items_;
  bool closed_ = false;
};

}  // namespace plm_vins
