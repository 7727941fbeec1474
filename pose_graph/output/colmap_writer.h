// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/camera/camera_model.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Writes keyframes and landmarks as a COLMAP text model (cameras.txt, images.txt, points3D.txt)
// into `folder`, which is created if missing. Worlds that are not connected with the first keyframe
// are omitted, since they have another frame. Images are named by timestamp as in an ASL folder,
// with the keyframe number appended where timestamps repeat. All pixels are projections into
// `camera`, the only camera of the model, since keyframes of a loaded map may have another one.
// COLMAP has no MEI model; it is replaced by an ideal pinhole. Throws std::runtime_error if a file
// cannot be written.
void WriteColmapModel(const std::string& folder, const CameraParameters& camera,
                      const KeyframeMap& map);

}  // namespace plm_vins
