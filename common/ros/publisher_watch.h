// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/datatypes.h>

#include <boost/shared_ptr.hpp>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace plm_vins {

// Detects when messages begin to come from another process: a restarted process has new
// connections. A connection that was lost and re-established is indistinguishable from a restart.
class PublisherWatch {
 public:
  // `topics` is the number of topics, all published by the watched process.
  explicit PublisherWatch(size_t topics) : sources_(topics) {}

  // To be called for each message with the header of its connection. Returns true once for each new
  // process except the first, at the first message of any of its topics.
  bool HasChanged(size_t topic, const boost::shared_ptr<ros::M_string>& connection) {
    Source& source = sources_[topic];
    if (source.connection == connection) {
      source.is_behind = false;  // same process: only the other topic reconnected
      return false;
    }
    const auto before = std::exchange(source.connection, connection);
    if (std::exchange(source.is_behind, false)) return false;
    for (Source& other : sources_) other.is_behind = &other != &source;
    return before != nullptr;
  }

 private:
  struct Source {
    boost::shared_ptr<ros::M_string> connection;  // held, so that its address is not reused
    bool is_behind = false;                       // another topic has a new connection already
  };

  std::vector<Source> sources_;
};

// Distinguishes alternating publishers from one that is restarted repeatedly.
class TurnsWatch {
 public:
  // To be called at each change of the publisher, at `now` [s] of any clock. Returns true if
  // changes follow each other faster than a process can start.
  bool AddChange(double now) {
    changes_.push_back(now);
    if (changes_.size() > kChanges) changes_.pop_front();
    return changes_.size() == kChanges && now - changes_.front() < kSpan;
  }

 private:
  static constexpr size_t kChanges = 3;
  static constexpr double kSpan = 1.0;  // [s]
  std::deque<double> changes_;          // newest changes
};

}  // namespace plm_vins
