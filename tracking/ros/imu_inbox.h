// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/ros/in_place_queue.h"
#include "common/ros/msg_conversion.h"
#include "common/ros/stream_monitor.h"

namespace plm_vins {

// Collects IMU samples for the callback thread of a node, so that the thread wakes for images
// instead of every sample. It calls `notice` in that thread when the thread waits for the next
// sample, and after every batch of samples.
class ImuInbox {
 public:
  ImuInbox(const ros::NodeHandle& node, const std::string& topic, std::function<void()> notice)
      : node_(node), notice_(boost::make_shared<Notice>(std::move(notice))) {
    subscriber_ = in_place_.Receiver(node).subscribe(topic, kQueue, &ImuInbox::Add, this,
                                                     ros::TransportHints().tcpNoDelay());
  }

  ~ImuInbox() {
    subscriber_.shutdown();
    node_.getCallbackQueue()->removeByID(NoticeId());
  }

  // Returns all samples since the last call, in order of arrival.
  std::vector<ImuSample> Take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(samples_, {});
  }

  // Requests a notice at the next sample. Returns false if a sample is available already.
  bool WaitForNext() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_wanted_ = samples_.empty();
    return is_wanted_;
  }

  // Requests a notice after all callbacks that wait already.
  void RequestNotice() { node_.getCallbackQueue()->addCallback(notice_, NoticeId()); }

  StreamMonitor& stream() { return stream_; }

 private:
  static constexpr uint32_t kQueue = 2000;
  static constexpr size_t kBatch = 20;

  struct Notice : ros::CallbackInterface {
    explicit Notice(std::function<void()> give) : give(std::move(give)) {}
    CallResult call() override {
      give();
      return Success;
    }
    const std::function<void()> give;
  };

  void Add(const sensor_msgs::Imu& message) {
    const ImuSample sample = ToImuSample(message);
    stream_.Add(sample.t_ns);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const bool is_full = samples_.size() == kQueue;  // the thread takes no samples
      if (is_full) samples_.erase(samples_.begin());
      samples_.push_back(sample);
      if (!is_wanted_ && (is_full || samples_.size() % kBatch != 0)) return;
      is_wanted_ = false;
    }
    RequestNotice();
  }

  uint64_t NoticeId() const { return reinterpret_cast<uint64_t>(this); }

  ros::NodeHandle node_;
  const boost::shared_ptr<Notice> notice_;
  StreamMonitor stream_{"imu"};
  std::mutex mutex_;  // guards the following members
  std::vector<ImuSample> samples_;
  bool is_wanted_ = false;

  InPlaceQueue in_place_;
  ros::Subscriber subscriber_;
};

}  // namespace plm_vins
