// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/publisher.h>

namespace plm_vins {

// Creates and publishes a message if there are subscribers.
template <typename MakeMessage>
void PublishIfWanted(const ros::Publisher& publisher, const MakeMessage& make_message) {
  if (publisher.getNumSubscribers() > 0) publisher.publish(make_message());
}

}  // namespace plm_vins
