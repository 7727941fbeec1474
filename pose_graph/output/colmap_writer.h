// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/camera/camera_model.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Writes the keyframes and their landmarks as a COLMAP text model: cameras.txt, images.txt and
// points3D.txt in `folder`, which is made where missing. Those of a world that is not connected
// with the first keyframe are left out: they are in another frame. Images are named by stamp, as
// those of an ASL folder, and by number as well where stamps repeat. All pixels are where `camera`,
// the only one of the model, sees the rays: the keyframes of a map that was loaded may be of
// another. COLMAP has no MEI camera: the model has an ideal pinhole instead. Throws
// std::runtime_error where a file cannot be written.
void WriteColmapModel(const std::string& folder, const CameraParameters& camera,
                      const KeyframeMap& map);

}  // namespace plm_vins
