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

// Warns on the console that no message has come on a topic, and again when other topics are
// published than at the last warning, since sensors and players may start later.
class SilenceWarner {
 public:
  // To be called regularly until the first message, after `silence` seconds of wall time.
  void Check(const std::string& topic, const std::string& type, double silence);

 private:
  std::string advice_;  // of the last warning
};

}  // namespace plm_vins
