// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "offline/recordings/bag_recording.h"

namespace plm_vins {

std::unique_ptr<Recording> OpenBags(const std::vector<std::string>& files,
                                    const std::vector<std::string>&, const std::string&,
                                    const std::string&) {
  throw std::runtime_error("cannot read " + files.front() + ": built without ROS (BUILD_ROS=OFF)");
}

}  // namespace plm_vins
