// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

namespace plm_vins {

enum class BlockKind : uint8_t {
  kPose,
  kMotion,
  kExtrinsic,
  kTimeOffset,
  kPoint,
  kLine,
  kIntrinsics,
  kDepthStream
};

// Persistent identifier of a variable, independent of where its values are stored: a frame's pose
// or motion by the frame's time, a landmark by its id, extrinsics and intrinsics by the number of
// the camera, time offset and depth stream by 0.
struct BlockId {
  BlockKind kind = BlockKind::kPose;
  int64_t key = 0;

  bool operator==(const BlockId& other) const { return kind == other.kind && key == other.key; }
};

struct BlockIdHash {
  size_t operator()(const BlockId& id) const {
    return std::hash<int64_t>()(id.key) * 31 + static_cast<size_t>(id.kind);
  }
};

}  // namespace plm_vins
