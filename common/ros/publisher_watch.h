// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/datatypes.h>

#include <boost/shared_ptr.hpp>
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

}  // namespace plm_vins
