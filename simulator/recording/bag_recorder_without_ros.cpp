// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "simulator/recording/recorder.h"

namespace plm_vins::simulator {

std::unique_ptr<Recorder> MakeBagRecorder(const std::string& file, const SensorConfig&) {
  throw std::runtime_error("cannot write " + file + ": built without ROS; use --asl DIR");
}

}  // namespace plm_vins::simulator
