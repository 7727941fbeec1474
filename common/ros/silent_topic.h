// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/ros/stream_monitor.h"

namespace plm_vins {

// Warns on the console that no message has come on a topic, and again when other topics are
// published than at the last warning, since sensors and players may start later.
class SilenceWarner {
 public:
  // Checks a subscription to `topic` with messages of `type`, for example "sensor_msgs/Image", and
  // is to be called regularly. Asks the master and waits for its answer.
  void Check(const std::string& topic, const std::string& type, const StreamMonitor& stream);

 private:
  std::string advice_;  // of the last warning
};

}  // namespace plm_vins
