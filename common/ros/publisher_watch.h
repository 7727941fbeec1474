// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/datatypes.h>

#include <boost/shared_ptr.hpp>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace plm_vins {

// Tells where the messages of a process begin to come from another one: a process that was started
// again has connections of its own. So has one whose link was lost and made again, which cannot be
// told apart.
class PublisherWatch {
 public:
  // Of so many topics, which the process publishes all.
  explicit PublisherWatch(size_t topics) : sources_(topics) {}

  // For each message of a topic, with the header of its connection. True once for each process but
  // the first, whichever of its topics comes first.
  bool HasChanged(size_t topic, const boost::shared_ptr<ros::M_string>& connection) {
    Source& source = sources_[topic];
    if (source.connection == connection) {
      source.is_behind = false;  // its process goes on: another topic's link alone was made again
      return false;
    }
    const auto before = std::exchange(source.connection, connection);
    if (std::exchange(source.is_behind, false)) return false;
    for (Source& other : sources_) other.is_behind = &other != &source;
    return before != nullptr;
  }

 private:
  struct Source {
    boost::shared_ptr<ros::M_string> connection;  // held, so that no other takes its address
    bool is_behind = false;                       // another topic came by a new one already
  };

  std::vector<Source> sources_;
};

// Tells publishers that send in turn from one that is started again and again.
class TurnsWatch {
 public:
  // For each change of the publisher, at `now` [s] of any clock. True where changes follow each
  // other within less than it takes to start a process.
  bool AddChange(double now) {
    changes_.push_back(now);
    if (changes_.size() > kChanges) changes_.pop_front();
    return changes_.size() == kChanges && now - changes_.front() < kSpan;
  }

 private:
  static constexpr size_t kChanges = 3;
  static constexpr double kSpan = 1.0;  // [s]
  std::deque<double> changes_;          // the newest
};

}  // namespace plm_vins
