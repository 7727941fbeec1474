// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/silent_topic.h"

#include <ros/master.h>

namespace plm_vins {
namespace {

constexpr char kRaw[] = "sensor_msgs/Image";
constexpr char kCompressed[] = "sensor_msgs/CompressedImage";

std::string Transport(const std::string& transport) {
  return "start with image_transport:=" + transport +
         " (for a node alone _image_transport:=" + transport + ")";
}

}  // namespace

TopicAdvice AdviseOnSilence(const std::string& topic, const std::string& type) {
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) return {};
  std::string others;
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
    if (other.datatype == type && other.name != topic) others += " " + other.name;
  }
  return {others.empty() ? "no topic of type " + type + " is published"
                         : "published topics of type " + type + ":" + others,
          false};
}

}  // namespace plm_vins
