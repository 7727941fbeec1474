// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>

namespace plm_vins {

// Callbacks of subscriptions with this queue run in the thread that receives their messages: to
// wake another one costs more than to take in an IMU sample. They may come beside all other
// callbacks, and hold up what else is received. Must outlive the subscriptions.
class InPlaceQueue : public ros::CallbackQueueInterface {
 public:
  // The same node, for subscriptions with this queue.
  ros::NodeHandle Receiver(ros::NodeHandle node) {
    node.setCallbackQueue(this);
    return node;
  }

  void addCallback(const ros::CallbackInterfacePtr& callback, uint64_t) override {
    callback->call();
  }
  void removeByID(uint64_t) override {}  // none waits here
};

}  // namespace plm_vins
