// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/io/output_file.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Writes a map: signature with version, size and checksum of what follows, then keyframes, nodes
// and edges. The file is there completely or, where that fails, as it was before. Throws
// std::runtime_error, which names the file and says why.
void SaveMap(const std::string& file, const KeyframeMap& map);
void SaveMap(const KeyframeMap& map, ReplacedFile* file);

// Reads it back, bit by bit. Throws std::runtime_error with one message where there is no such
// file, or it cannot be read, is none of a map, of another version, damaged, or holds what no map
// can: whatever it returns can be worked with.
KeyframeMap LoadMap(const std::string& file);

struct PreviousMap {
  KeyframeMap map;
  std::string warning;  // why it is empty; empty: it is not
};

// The map that load_previous_pose_graph asks for: an empty one where there is no such file, as in
// configurations of VINS-Mono and PL-VINS, whose folder is on another machine. Else as LoadMap().
PreviousMap LoadPreviousMap(const std::string& file);

}  // namespace plm_vins
