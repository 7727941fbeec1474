// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "common/config/config.h"
#include "simulator/recording/recorder.h"

namespace plm_vins::simulator {

// Creates a ROS bag with the topics of the configuration. Throws std::runtime_error if the file
// cannot be written or the program was built without ROS.
std::unique_ptr<Recorder> MakeBagRecorder(const std::string& file, const SensorConfig& sensors);

}  // namespace plm_vins::simulator
