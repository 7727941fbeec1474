// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/bag_recording.h"

#include <ros/serialization.h>

#include <cerrno>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "common/ros/geometry_conversion.h"
#include "common/ros/image_conversion.h"
#include "common/ros/msg_conversion.h"
#include "common/ros/topic_names.h"
#include "offline/ros/indexed_bag.h"

namespace plm_vins {
namespace {

constexpr char kRaw[] = "sensor_msgs/Image";
constexpr char kCompressed[] = "sensor_msgs/CompressedImage";
constexpr char kImu[] = "sensor_msgs/Imu";

void RequireReadable(const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    throw std::runtime_error(file + " is not a file; --bag takes a ROS bag, --asl a folder");
  }
  if (!std::ifstream(file)) {
    const std::string reason = std::generic_category().message(errno);
    throw std::runtime_error("cannot read " + file + ": " + reason);
  }
}

IndexedBag OpenIndexedBag(const std::string& file) {
  RequireReadable(file);
  try {
    return IndexedBag(file);
  } catch (const std::exception& error) {  // exceptions of bag parsing, or std::bad_alloc
    throw std::runtime_error(
        file + " is not a ROS bag of format 2.0, or it was cut off, damaged or never closed (" +
        error.what() + "); then \"rosbag reindex " + file + "\" makes it whole");
  }
}

// Returns the topic of this type as named in the bag: with a leading slash or, from some recorders,
// without. Returns nullopt if there is none.
std::optional<TypedTopic> Find(const TypedTopics& topics, const std::string& topic,
                               const std::string& type) {
  for (const TypedTopic& typed : topics) {
    if (AbsoluteTopic(typed.first) == AbsoluteTopic(topic) && typed.second == type) return typed;
  }
  return std::nullopt;
}

std::string Missing(const std::string& key, const std::string& topic, const std::string& type) {
  return " no topic " + AbsoluteTopic(topic) + " (" + type + ") for the key " + key + ",";
}

std::string ToText(const TypedTopics& topics) {
  std::string text;
  for (const auto& [topic, type] : topics) text.append(" " + topic).append(" (" + type + ")");
  return text.empty() ? " nothing" : text;
}

using ros::serialization::IStream;

IStream StreamOf(const BagMessage& message) {
  // The stream requires a non-const pointer, but only reads.
  auto* bytes = reinterpret_cast<uint8_t*>(const_cast<char*>(message.data.data()));
  return {bytes, static_cast<uint32_t>(message.data.size())};
}

void SkipToPixels(IStream* stream, sensor_msgs::Image image) {
  stream->next(image.header);
  stream->next(image.height);
  stream->next(image.width);
  stream->next(image.encoding);
  stream->next(image.is_bigendian);
  stream->next(image.step);
}

void SkipToPixels(IStream* stream, sensor_msgs::CompressedImage image) {
  stream->next(image.header);
  stream->next(image.format);
}

template <typename Message>
Message Deserialize(const BagMessage& message) {
  Message result;
  IStream stream = StreamOf(message);
  ros::serialization::deserialize(stream, result);
  return result;
}

// Checks the size first, since roscpp allocates the claimed number of pixels before it compares it
// with the message.
template <typename Message>
Message DeserializeImage(const BagMessage& message) {
  IStream stream = StreamOf(message);
  SkipToPixels(&stream, Message());
  uint32_t size = 0;
  stream.next(size);
  stream.advance(size);
  return Deserialize<Message>(message);
}

class BagRecording : public Recording {
 public:
  BagRecording(const std::string& file, const std::string& image_topic,
               const std::string& imu_topic, const std::string& right_topic,
               const std::string& depth_topic)
      : file_(file), bag_(OpenIndexedBag(file)) {
    const TypedTopics topics = bag_.topics();
    std::string missing;
    const auto add = [&](RecordingEvent::Kind kind, const std::optional<TypedTopic>& found,
                         const std::string& lack) {
      if (found) kinds_[*found] = kind;
      if (!found) missing += lack;
    };
    using Kind = RecordingEvent::Kind;
    const std::string any_image = kRaw + std::string(" or ") + kCompressed;
    if (!right_topic.empty()) {
      add(Kind::kRightImage, FindImages(topics, right_topic),
          Missing("image1_topic", right_topic, any_image));
    }
    if (!depth_topic.empty()) {
      add(Kind::kDepth, Find(topics, depth_topic, kRaw), Missing("depth_topic", depth_topic, kRaw));
    }
    add(Kind::kImage, FindImages(topics, image_topic),
        Missing("image_topic", image_topic, any_image));
    add(Kind::kImu, Find(topics, imu_topic, kImu), Missing("imu_topic", imu_topic, kImu));
    if (!missing.empty()) {
      throw std::runtime_error(file + " has" + missing + " but:" + ToText(topics));
    }
    TypedTopics selected;
    for (const auto& [topic, kind] : kinds_) selected.insert(topic);
    bag_.Select(selected);
  }

  std::optional<RecordingEvent> Next() override {
    while (const auto message = bag_.Next()) {
      try {
        const RecordingEvent::Kind kind = kinds_.at(message->topic);
        return kind == RecordingEvent::Kind::kImu ? ImuEvent(*message) : ImageEvent(*message, kind);
      } catch (const ros::serialization::StreamOverrunException&) {
        malformed_.Add(message->topic.second + " on " + message->topic.first);
      }
    }
    return std::nullopt;
  }

  std::optional<cv::Mat> LoadImage() override {
    try {
      if (is_depth_) {
        const sensor_msgs::ImageConstPtr borrowed(&raw_image_, [](const sensor_msgs::Image*) {});
        return ToDepthSample(borrowed).depth.clone();
      }
      return is_compressed_ ? ToImageSample(compressed_image_).gray
                            : ToImageSample(raw_image_).gray;
    } catch (const std::invalid_argument& error) {
      unreadable_images_.Add(error.what());
      return std::nullopt;
    }
  }

  std::string name() const override { return file_; }
  std::string Source(RecordingEvent::Kind kind) const override {
    const std::string key = kind == RecordingEvent::Kind::kImage ? "image_topic " : "imu_topic ";
    for (const auto& [topic, own_kind] : kinds_) {
      if (own_kind == kind) return key + topic.first;
    }
    return key;
  }
  std::optional<int64_t> end_ns() const override { return bag_.end_ns(); }

  DropCounts problems() const override {
    DropCounts counts = bag_.problems();
    counts.push_back(unreadable_images_);
    counts.push_back(malformed_);
    return counts;
  }

 private:
  static std::optional<TypedTopic> FindImages(const TypedTopics& topics, const std::string& topic) {
    auto images = Find(topics, topic, kRaw);
    if (!images) images = Find(topics, topic, kCompressed);
    if (!images) images = Find(topics, topic + "/compressed", kCompressed);
    return images;
  }

  RecordingEvent ImuEvent(const BagMessage& message) const {
    const ImuSample sample = ToImuSample(Deserialize<sensor_msgs::Imu>(message));
    return {RecordingEvent::Kind::kImu, sample.t_ns, sample};
  }

  RecordingEvent ImageEvent(const BagMessage& message, RecordingEvent::Kind kind) {
    ros::Time stamp;
    is_depth_ = kind == RecordingEvent::Kind::kDepth;
    is_compressed_ = message.topic.second == kCompressed;
    if (is_compressed_) {
      compressed_image_ = DeserializeImage<sensor_msgs::CompressedImage>(message);
      stamp = compressed_image_.header.stamp;
    } else {
      raw_image_ = DeserializeImage<sensor_msgs::Image>(message);
      stamp = raw_image_.header.stamp;
    }
    return {kind, ToNanoseconds(stamp), {}};
  }

  std::string file_;
  IndexedBag bag_;
  std::map<TypedTopic, RecordingEvent::Kind> kinds_;  // of the selected topics
  bool is_depth_ = false, is_compressed_ = false;     // of the last image
  sensor_msgs::Image raw_image_;
  sensor_msgs::CompressedImage compressed_image_;
  DropCount unreadable_images_{"images_unreadable", 0, ""};
  DropCount malformed_{"messages_malformed", 0, ""};
};

}  // namespace

std::unique_ptr<Recording> OpenBag(const std::string& file, const std::string& image_topic,
                                   const std::string& imu_topic, const std::string& right_topic,
                                   const std::string& depth_topic) {
  return std::make_unique<BagRecording>(file, image_topic, imu_topic, right_topic, depth_topic);
}

}  // namespace plm_vins
