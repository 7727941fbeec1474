// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/bag_recording.h"

#include <ros/serialization.h>

#include <map>
#include <optional>
#include <stdexcept>

#include "common/ros/geometry_conversion.h"
#include "common/ros/image_conversion.h"
#include "common/ros/msg_conversion.h"
#include "common/ros/topic_names.h"
#include "offline/ros/joined_bags.h"

namespace plm_vins {
namespace {

constexpr char kRaw[] = "sensor_msgs/Image";
constexpr char kCompressed[] = "sensor_msgs/CompressedImage";
constexpr char kImu[] = "sensor_msgs/Imu";

// Returns the topic of this type as named in the bag: with a leading slash or, from some recorders,
// without. Returns nullopt if there is none.
std::optional<TypedTopic> Find(const TypedTopics& topics, const std::string& topic,
                               const std::string& type) {
  for (const TypedTopic& typed : topics) {
    if (AbsoluteTopic(typed.first) == AbsoluteTopic(topic) && typed.second == type) return typed;
  }
  return std::nullopt;
}

std::string Join(const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) text += (text.empty() ? "" : " ") + file;
  return text;
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
  BagRecording(const std::vector<std::string>& files, const std::string& image_topic,
               const std::string& imu_topic, const std::string& right_topic,
               const std::string& depth_topic)
      : name_(Join(files)), bags_(files) {
    const TypedTopics topics = bags_.topics();
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
      throw std::runtime_error(name_ + " has" + missing + " but:" + ToText(topics));
    }
    TypedTopics selected;
    for (const auto& [topic, kind] : kinds_) selected.insert(topic);
    bags_.Select(selected);
  }

  std::optional<RecordingEvent> Next() override {
    while (const auto message = bags_.Next()) {
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

  std::string name() const override { return name_; }
  std::string Source(RecordingEvent::Kind kind) const override {
    const std::string key = kind == RecordingEvent::Kind::kImage ? "image_topic " : "imu_topic ";
    for (const auto& [topic, own_kind] : kinds_) {
      if (own_kind == kind) return key + topic.first;
    }
    return key;
  }
  std::optional<int64_t> end_ns() const override { return bags_.end_ns(); }

  DropCounts problems() const override {
    DropCounts counts = bags_.problems();
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

  std::string name_;
  JoinedBags bags_;
  std::map<TypedTopic, RecordingEvent::Kind> kinds_;  // selected topics
  bool is_depth_ = false, is_compressed_ = false;     // properties of the last image
  sensor_msgs::Image raw_image_;
  sensor_msgs::CompressedImage compressed_image_;
  DropCount unreadable_images_{"images_unreadable", 0, ""};
  DropCount malformed_{"messages_malformed", 0, ""};
};

}  // namespace

std::unique_ptr<Recording> OpenBags(const std::vector<std::string>& files,
                                    const std::string& image_topic, const std::string& imu_topic,
                                    const std::string& right_topic,
                                    const std::string& depth_topic) {
  return std::make_unique<BagRecording>(files, image_topic, imu_topic, right_topic, depth_topic);
}

}  // namespace plm_vins
