// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "offline/recordings/bag_recording.h"

namespace plm_vins {

std::unique_ptr<Recording> OpenBag(const std::string& file, const std::string&, const std::string&,
                                   const std::string&, const std::string&) {
  throw std::runtime_error("cannot read " + file + ": built without ROS (BUILD_ROS=OFF)");
}

}  // namespace plm_vins
