// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// The pose graph in the text format of g2o [Kuemmerle2011], as VERTEX_SE3:QUAT T_M_L and
// EDGE_SE3:QUAT: roll and pitch, which gravity holds, are zero and firmly weighted.
void WriteG2o(const KeyframeMap& map, std::ostream* stream);

}  // namespace plm_vins
