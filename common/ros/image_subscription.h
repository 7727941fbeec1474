// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_transport/subscriber.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "common/measurements.h"
#include "common/ros/stream_monitor.h"
#include "common/streams/drop_counts.h"

namespace plm_vins {

// Grey images of a topic, by the transport that ~image_transport names: raw (default), compressed
// (decoded here, no plugin needed) or any plugin's name. Ends with the subscription, which waits
// for a callback that runs.
class ImageSubscription {
 public:
  // An image, or nothing where a message cannot be made one, which is counted.
  using Callback = std::function<void(std::optional<ImageSample>)>;

  // Once. Callbacks come by the queue of `node` from here on, at most `queue` of them waiting.
  void Subscribe(ros::NodeHandle node, const ros::NodeHandle& private_node,
                 const std::string& topic, uint32_t queue, Callback callback);

  // What is subscribed, in full: with namespace, remapping and transport.
  std::string topic() const;

  // For any threads. Of all messages, and the wall time since the last that was an image [s].
  StreamMonitor& stream() { return stream_; }
  double SilenceOfImages() const { return readable_.Silence(); }
  DropCount unreadable() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return unreadable_;
  }

 private:
  template <typename Message>
  void Read(const std_msgs::Header& header, const Message& message);

  Callback callback_;
  StreamMonitor stream_{"images"};
  StreamMonitor readable_{"readable_images"};
  mutable std::mutex mutex_;  // guards the count
  DropCount unreadable_{"images_unreadable", 0, ""};
  image_transport::Subscriber subscriber_;
  ros::Subscriber compressed_subscriber_;
};

}  // namespace plm_vins
