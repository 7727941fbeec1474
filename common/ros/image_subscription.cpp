// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/image_subscription.h"

#include <image_transport/image_transport.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <exception>
#include <utility>

#include "common/ros/geometry_conversion.h"
#include "common/ros/image_conversion.h"
#include "common/ros/parameter.h"

namespace plm_vins {

void ImageSubscription::Subscribe(ros::NodeHandle node, const ros::NodeHandle& private_node,
                                  const std::string& topic, uint32_t queue, Callback callback,
                                  Selector is_needed) {
  callback_ = std::move(callback);
  is_needed_ = std::move(is_needed);
  const auto transport =
      FindParameter<std::string>(private_node, "image_transport").value_or("raw");
  // A remapping refers to the topic without the transport suffix, and must be applied only once.
  const std::string base = transport == "raw" ? topic : node.resolveName(topic);
  if (transport == "compressed") {
    compressed_subscriber_ = node.subscribe<sensor_msgs::CompressedImage>(
        base + "/compressed", queue, [this](const sensor_msgs::CompressedImageConstPtr& message) {
          Read(message->header, *message);
        });
  } else {
    subscriber_ = image_transport::ImageTransport(node).subscribe(
        base, queue,
        [this](const sensor_msgs::ImageConstPtr& message) { Read(message->header, message); },
        nullptr, image_transport::TransportHints(transport, ros::TransportHints(), private_node));
  }
}

std::string ImageSubscription::topic() const {
  return compressed_subscriber_ ? compressed_subscriber_.getTopic() : subscriber_.getTopic();
}

std::string ImageSubscription::type() const {
  return compressed_subscriber_ ? "sensor_msgs/CompressedImage" : "sensor_msgs/Image";
}

// `message` is a message, or a pointer to one whose pixels are shared.
template <typename Message>
void ImageSubscription::Read(const std_msgs::Header& header, const Message& message) {
  const int64_t t_ns = ToNanoseconds(header.stamp);
  stream_.Add(t_ns);
  if (!is_needed_(t_ns)) return callback_(ImageSample{t_ns, {}});
  std::optional<ImageSample> image;
  try {
    image = ToImageSample(message);
    readable_.Add(image->t_ns);
  } catch (const std::exception& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    unreadable_.Add(error.what());
  }
  callback_(std::move(image));
}

}  // namespace plm_vins
