// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/bag_recording.h"

#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/config/sensor_config.h"
#include "common/format.h"
#include "common/ros/geometry_conversion.h"
#include "common/ros/image_conversion.h"
#include "common/ros/msg_conversion.h"
#include "common/ros/names.h"

namespace plm_vins {
namespace {

// A topic and a message type; a topic may have several types.
using TypedTopic = std::pair<std::string, std::string>;
using TypedTopics = std::set<TypedTopic>;

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

std::string Missing(const std::string& key, const std::string& topic, const std::string& type) {
  return " no topic " + AbsoluteTopic(topic) + " (" + type + ") for the key " + key + ",";
}

std::string ToText(const TypedTopics& topics) {
  std::string text;
  for (const auto& [topic, type] : topics) text.append(" " + topic).append(" (" + type + ")");
  return text.empty() ? " nothing" : text;
}

void RequireReadable(const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    throw std::runtime_error(file + " is not a file");
  }
  if (!std::ifstream(file)) {
    const std::string reason = std::generic_category().message(errno);
    throw std::runtime_error("cannot read " + file + ": " + reason);
  }
}

std::unique_ptr<rosbag::Bag> OpenBag(const std::string& file) {
  RequireReadable(file);
  try {
    return std::make_unique<rosbag::Bag>(file);
  } catch (const std::exception& error) {  // exceptions of rosbag, or std::bad_alloc
    throw std::runtime_error(
        file +
        " is not a ROS bag of format 2.0, or it is truncated, damaged or was never closed (" +
        error.what() + "); \"rosbag reindex " + file + "\" repairs a truncated or unclosed bag");
  }
}

// Reads several bags, such as those of `rosbag record --split`, as if they were one: messages are
// merged by their recording time, whatever the order of the files.
class BagRecording : public Recording {
 public:
  BagRecording(const std::vector<std::string>& files, const std::vector<std::string>& image_topics,
               const std::string& imu_topic, const std::string& depth_topic)
      : name_(JoinTexts(files, " ")) {
    rosbag::View all;
    for (const std::string& file : files) {
      bags_.push_back(OpenBag(file));
      all.addQuery(*bags_.back());
    }
    TypedTopics topics;
    for (const rosbag::ConnectionInfo* of : all.getConnections()) {
      topics.emplace(of->topic, of->datatype);
    }
    std::string missing;
    const auto add = [&](const Stream& stream, const std::string& topic, const std::string& type,
                         const std::optional<TypedTopic>& found) {
      if (found) streams_[*found] = stream;
      if (!found) missing += Missing(stream.key, topic, type);
    };
    using Kind = RecordingEvent::Kind;
    const std::string any_image = kRaw + std::string(" or ") + kCompressed;
    for (size_t i = 0; i < image_topics.size(); ++i) {
      const int camera = static_cast<int>(i);
      add({Kind::kImage, camera, TopicKey(camera)}, image_topics[i], any_image,
          FindImages(topics, image_topics[i]));
    }
    if (!depth_topic.empty()) {
      add({Kind::kDepth, 0, "depth_topic"}, depth_topic, kRaw, Find(topics, depth_topic, kRaw));
    }
    add({Kind::kImu, 0, "imu_topic"}, imu_topic, kImu, Find(topics, imu_topic, kImu));
    if (!missing.empty()) {
      throw std::runtime_error(name_ + " has" + missing + " but:" + ToText(topics));
    }
    const auto is_selected = [this](const rosbag::ConnectionInfo* of) { return Uses(of->topic); };
    for (const auto& bag : bags_) messages_.addQuery(*bag, is_selected);
    next_ = messages_.begin();
    if (next_ != messages_.end()) end_ns_ = ToNanoseconds(messages_.getEndTime());
  }

  std::optional<RecordingEvent> Next() override {
    std::optional<RecordingEvent> event;
    while (!event && next_ != messages_.end()) {
      event = Read(*next_);
      ++next_;
    }
    return event;
  }

  std::optional<cv::Mat> LoadImage() override {
    try {
      if (is_depth_) return ToDepthSample(raw_image_).depth.clone();
      return compressed_image_ ? ToImageSample(*compressed_image_).gray
                               : ToImageSample(*raw_image_).gray;
    } catch (const std::invalid_argument& error) {
      (is_depth_ ? unreadable_depth_ : unreadable_images_).Add(error.what());
      return std::nullopt;
    }
  }

  std::string name() const override { return name_; }
  std::string Source(RecordingEvent::Kind kind) const override {
    for (const auto& [topic, stream] : streams_) {
      if (stream.kind == kind && stream.camera == 0) return stream.key + " " + topic.first;
    }
    return "";
  }
  std::optional<int64_t> end_ns() const override { return end_ns_; }

  DropCounts problems() const override {
    return {damaged_, of_another_type_, unreadable_images_, unreadable_depth_, malformed_};
  }

 private:
  struct Stream {
    RecordingEvent::Kind kind = RecordingEvent::Kind::kImu;
    int camera = 0;
    std::string key;  // of the topic
  };

  static std::optional<TypedTopic> FindImages(const TypedTopics& topics, const std::string& topic) {
    auto images = Find(topics, topic, kRaw);
    if (!images) images = Find(topics, topic, kCompressed);
    if (!images) images = Find(topics, topic + "/compressed", kCompressed);
    return images;
  }

  bool Uses(const std::string& topic) const {
    return std::any_of(streams_.begin(), streams_.end(),
                       [&](const auto& used) { return used.first.first == topic; });
  }

  // Returns nullopt, and counts the problem, if the message cannot be used.
  std::optional<RecordingEvent> Read(const rosbag::MessageInstance& message) {
    const std::string name = message.getDataType() + " on " + message.getTopic();
    const auto stream = streams_.find({message.getTopic(), message.getDataType()});
    try {
      if (stream == streams_.end()) {
        of_another_type_.Add(name);
      } else if (stream->second.kind != RecordingEvent::Kind::kImu) {
        return ImageEvent(message, stream->second);
      } else if (const auto imu = message.instantiate<sensor_msgs::Imu>()) {
        const ImuSample sample = ToImuSample(*imu);
        return RecordingEvent{RecordingEvent::Kind::kImu, sample.t_ns, sample, 0};
      }
    } catch (const ros::serialization::StreamOverrunException&) {
      malformed_.Add(name);
    } catch (const std::exception& error) {  // exceptions of rosbag, or std::bad_alloc
      damaged_.Add(name + ": " + error.what() + "; \"rosbag reindex\" may help");
    }
    return std::nullopt;
  }

  std::optional<RecordingEvent> ImageEvent(const rosbag::MessageInstance& message,
                                           const Stream& stream) {
    is_depth_ = stream.kind == RecordingEvent::Kind::kDepth;
    compressed_image_ = message.instantiate<sensor_msgs::CompressedImage>();
    if (compressed_image_) return StampedEvent(stream, compressed_image_->header);
    raw_image_ = message.instantiate<sensor_msgs::Image>();
    if (raw_image_) return StampedEvent(stream, raw_image_->header);
    return std::nullopt;
  }

  static RecordingEvent StampedEvent(const Stream& stream, const std_msgs::Header& header) {
    return {stream.kind, ToNanoseconds(header.stamp), {}, stream.camera};
  }

  std::string name_;
  std::vector<std::unique_ptr<rosbag::Bag>> bags_;
  rosbag::View messages_;  // of the selected topics
  rosbag::View::iterator next_;
  std::optional<int64_t> end_ns_;
  std::map<TypedTopic, Stream> streams_;  // selected topics
  bool is_depth_ = false;                 // property of the last image
  sensor_msgs::ImageConstPtr raw_image_;  // the last image, unless it is compressed
  sensor_msgs::CompressedImageConstPtr compressed_image_;
  DropCount damaged_{"bag_damaged", 0, ""};
  DropCount of_another_type_{"messages_of_another_type", 0, ""};
  DropCount unreadable_images_{"images_unreadable", 0, ""};
  DropCount unreadable_depth_{"depth_images_unreadable", 0, ""};
  DropCount malformed_{"messages_malformed", 0, ""};
};

}  // namespace

std::unique_ptr<Recording> OpenBags(const std::vector<std::string>& files,
                                    const std::vector<std::string>& image_topics,
                                    const std::string& imu_topic, const std::string& depth_topic) {
  return std::make_unique<BagRecording>(files, image_topics, imu_topic, depth_topic);
}

}  // namespace plm_vins
