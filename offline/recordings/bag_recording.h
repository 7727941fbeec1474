// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "offline/recordings/recording.h"

namespace plm_vins {

// Opens a ROS bag without a ROS master. The images may be raw or compressed (on the topic itself or
// on topic + "/compressed"). Throws std::runtime_error where the file is not a bag, where it is
// truncated or was never closed (`rosbag reindex` helps), and where a topic is missing or of
// another type, naming its key and the topics that there are. A build without ROS always throws.
std::unique_ptr<Recording> OpenBag(const std::string& file, const std::string& image_topic,
                                   const std::string& imu_topic);

}  // namespace plm_vins
