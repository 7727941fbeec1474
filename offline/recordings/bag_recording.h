// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "offline/recordings/recording.h"

namespace plm_vins {

// Opens ROS bags without a ROS master. Several bags are read as one: their messages are merged by
// time, and each topic need be in only one of them. Images may be raw or compressed (on the topic
// itself or on topic + "/compressed"), depth is raw, and read if its topic is not empty.
// `image_topics` are those of the cameras, by number. Throws std::runtime_error if a file is not a
// bag, is truncated or was never closed (`rosbag reindex` helps), or if a topic is missing or has
// another type; the message names its key and the available topics. Always throws in a build
// without ROS.
std::unique_ptr<Recording> OpenBags(const std::vector<std::string>& files,
                                    const std::vector<std::string>& image_topics,
                                    const std::string& imu_topic,
                                    const std::string& depth_topic = "");

}  // namespace plm_vins
