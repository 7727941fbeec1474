// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Writes the pose graph in the text format of g2o [Kuemmerle2011], with vertices VERTEX_SE3:QUAT
// T_M_L and edges EDGE_SE3:QUAT. Roll and pitch, which gravity determines, are zero and have a
// large weight.
void WriteG2o(const KeyframeMap& map, std::ostream* stream);

}  // namespace plm_vins
