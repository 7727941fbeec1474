// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// Advice to the user of a topic on which nothing comes, by what the master knows.
struct TopicAdvice {
  std::string text;         // what is published instead, and what to do; empty without a master
  bool is_certain = false;  // the same data come in another form: there is no use in waiting
};

// For a subscription to `topic` with messages of `type`, e.g. "sensor_msgs/Image". Asks the master,
// and waits for its answer.
TopicAdvice AdviseOnSilence(const std::string& topic, const std::string& type);

}  // namespace plm_vins
