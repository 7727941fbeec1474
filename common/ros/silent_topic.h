// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// Advice to the user about a topic without messages, from what the ROS master knows.
struct TopicAdvice {
  std::string text;         // other published topics and what to do; empty without a master
  bool is_certain = false;  // the data are published in another form; waiting is useless
};

// Returns advice on a subscription to `topic` with messages of `type`, for example
// "sensor_msgs/Image". Asks the master and waits for its answer.
TopicAdvice AdviseOnSilence(const std::string& topic, const std::string& type);

}  // namespace plm_vins
