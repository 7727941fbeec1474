// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/io/output_file.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Writes a map: signature with version, size and checksum, then keyframes, nodes and edges. The
// file is replaced atomically: on failure the previous one remains. Throws std::runtime_error with
// file name and reason.
void SaveMap(const std::string& file, const KeyframeMap& map);
void SaveMap(const KeyframeMap& map, ReplacedFile* file);

// Reads a map; numbers are restored exactly. Throws std::runtime_error with one message if the file
// is missing, unreadable, not a map, of another version or damaged.
KeyframeMap LoadMap(const std::string& file);

struct PreviousMap {
  KeyframeMap map;
  std::string warning;  // reason why the map is empty, or an empty string
};

// Loads the map of load_previous_pose_graph. A missing file yields an empty map with a warning,
// since configurations of VINS-Mono and PL-VINS name folders of other machines. Otherwise it
// behaves like LoadMap().
PreviousMap LoadPreviousMap(const std::string& file);

}  // namespace plm_vins
