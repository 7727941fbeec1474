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

// Subscribes to gray images with the transport named by ~image_transport: raw (default), compressed
// (decoded here without a plugin) or the name of any plugin. The destructor unsubscribes and waits
// for a running callback.
class ImageSubscription {
 public:
  // `name` names the stream in diagnostics.
  explicit ImageSubscription(const std::string& name = "images") : stream_(name) {
    unreadable_.cause = name + "_unreadable";
  }

  // Receives an image, or nullopt if a message cannot be converted, which is counted.
  using Callback = std::function<void(std::optional<ImageSample>)>;

  // Returns whether the pixels of an image with this timestamp are needed. An image that is not
  // needed is not decoded: the callback receives it without pixels.
  using Selector = std::function<bool(int64_t t_ns)>;

  // Must be called once. Callbacks come through the queue of `node`, with at most `queue` waiting.
  void Subscribe(
      ros::NodeHandle node, const ros::NodeHandle& private_node, const std::string& topic,
      uint32_t queue, Callback callback, Selector is_needed = [](int64_t) { return true; });

  // Full name of the subscribed topic, with namespace, remapping and transport.
  std::string topic() const;
  std::string type() const;  // message type

  // Thread-safe: statistics of all messages, and wall time since the last readable image [s].
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
  Selector is_needed_;
  StreamMonitor stream_;
  StreamMonitor readable_{"readable_images"};
  mutable std::mutex mutex_;  // guards the count
  DropCount unreadable_;
  image_transport::Subscriber subscriber_;
  ros::Subscriber compressed_subscriber_;
};

}  // namespace plm_vins
