// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/silent_topic.h"

#include <ros/console.h>
#include <ros/master.h>

#include <set>

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr double kMinSilence = 2, kLongSilence = 10;  // [s]
constexpr char kRaw[] = "sensor_msgs/Image";
constexpr char kCompressed[] = "sensor_msgs/CompressedImage";

// Advice to the user about a topic without messages, from what the ROS master knows.
struct TopicAdvice {
  std::string text;         // other published topics and what to do; empty without a master
  bool is_certain = false;  // the data are published in another form; waiting is useless
};

std::string Transport(const std::string& transport) {
  return "start with image_transport:=" + transport +
         " (for a node alone _image_transport:=" + transport + ")";
}

// Returns whether a topic has the pictures of a tracker or of the pose graph, of any camera.
bool IsOfSuite(const std::string& topic) {
  for (const char* name : {"/feature_img", "/linefeature_img", "/match_image"}) {
    if (topic.find(name) != std::string::npos) return true;
  }
  return false;
}

TopicAdvice AdviseOnSilence(const std::string& topic, const std::string& type) {
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) return {};
  std::set<std::string> others;  // the master's order may change
  for (const ros::master::TopicInfo& other : topics) {
    if (other.name == topic && other.datatype == kCompressed) {
      return {"its messages are compressed images: " + Transport("compressed") + ", and remap " +
                  topic + "/compressed to it",
              true};
    }
    if (other.name == topic && other.datatype != type && other.datatype != "*") {
      return {"its messages have another type, " + other.datatype + " instead of " + type, true};
    }
    if (other.name == topic + "/compressed" && other.datatype == kCompressed) {
      return {"but " + other.name + " is published: " + Transport("compressed"), true};
    }
    if (other.name + "/compressed" == topic && other.datatype == kRaw) {
      return {"but " + other.name + " is published: start without image_transport:=compressed",
              true};
    }
    if (other.datatype == type && other.name != topic && !IsOfSuite(other.name)) {
      others.insert(other.name);
    }
  }
  if (others.empty()) return {"no topic of type " + type + " is published", false};
  return {
      "published topics of type " + type + ": " + JoinTexts({others.begin(), others.end()}, " "),
      false};
}

}  // namespace

void SilenceWarner::Check(const std::string& topic, const std::string& type,
                          const StreamMonitor& stream) {
  const double silence = stream.Silence();
  if (stream.HasMessages() || silence < kMinSilence) return;
  const TopicAdvice advice = AdviseOnSilence(topic, type);
  if (advice.text == advice_ || (!advice.is_certain && silence < kLongSilence)) return;
  advice_ = advice.text;
  ROS_WARN_STREAM("no messages on " << topic << "; " << advice.text);
}

}  // namespace plm_vins
