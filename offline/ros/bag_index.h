// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// Throws std::runtime_error where the index of a bag of format 2.0 names messages that are not
// where it says: rosbag would follow it out of its buffers. Looks at the records' headers only, and
// not into compressed chunks, whose content has checksums of its own. Other files and bags without
// an index pass; rosbag refuses them.
void CheckBagIndex(const std::string& file);

}  // namespace plm_vins
