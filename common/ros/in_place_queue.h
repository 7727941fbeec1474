// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>

namespace plm_vins {

// A callback queue that runs callbacks in the thread that receives the messages, since waking
// another thread costs more than processing an IMU sample. Such callbacks may run concurrently with
// all others, and delay other messages. The queue must outlive its subscriptions.
class InPlaceQueue : public ros::CallbackQueueInterface {
 public:
  // Returns a handle of the same node for subscriptions with this queue.
  ros::NodeHandle Receiver(ros::NodeHandle node) {
    node.setCallbackQueue(this);
    return node;
  }

  void addCallback(const ros::CallbackInterfacePtr& callback, uint64_t) override {
    callback->call();
  }
  void removeByID(uint64_t) override {}  // no callback ever waits
};

}  // namespace plm_vins
