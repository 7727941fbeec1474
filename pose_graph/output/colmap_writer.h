// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/camera/camera_model.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Writes the keyframes and their landmarks as a COLMAP text model: cameras.txt, images.txt and
// points3D.txt in `folder`, which is made where missing. Images are named by stamp, as those of an
// ASL folder. COLMAP has no MEI camera: its model has the pixels of an ideal pinhole instead.
// Throws std::runtime_error where a file cannot be written.
void WriteColmapModel(const std::string& folder, const CameraParameters& camera,
                      const KeyframeMap& map);

}  // namespace plm_vins
