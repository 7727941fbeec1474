// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace plm_vins {

// First in, first out between threads, never more than `capacity` items: a full queue makes the
// producer wait, so that nothing is lost and memory stays bounded. A producer that must not wait
// pushes over the oldest, or quietly, and a full queue refuses the item.
template <typename T>
class BoundedQueue {
 public:
  explicit BoundedQueue(size_t capacity) : capacity_(capacity) {}

  // Waits while the queue is full. False, and the item is gone, once the queue is closed.
  bool Push(T item) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || items_.size() < capacity_; });
    if (closed_) return false;
    items_.push_back(std::move(item));
    changed_.notify_all();
    return true;
  }

  // Never waits, and wakes no consumer unless it fills the queue: Wake() or the next Push() does.
  // False, and the item is gone, where the queue is full or closed.
  bool PushQuietly(T item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (closed_ || items_.size() == capacity_) return false;
    items_.push_back(std::move(item));
    if (items_.size() == capacity_) changed_.notify_all();
    return true;
  }
  void Wake() { changed_.notify_all(); }

  // Never waits: of a full queue the oldest item goes, which is true then.
  bool PushOverOldest(T item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (closed_) return false;
    const bool is_full = items_.size() == capacity_;
    if (is_full) items_.pop_front();
    items_.push_back(std::move(item));
    changed_.notify_all();
    return is_full;
  }

  // Waits while the queue is empty. Nothing once it is closed and all items are taken.
  std::optional<T> Pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    std::optional<T> item = std::move(items_.front());
    items_.pop_front();
    changed_.notify_all();
    return item;
  }

  // No more items come in; wakes everyone who waits.
  void Close() {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  // The same, and what still waits is gone.
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
