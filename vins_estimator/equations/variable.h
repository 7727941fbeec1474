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

using PlusFunction = void (*)(const double* x, const double* delta, double* x_plus_delta);
using MinusFunction = void (*)(const double* y, const double* x, double* y_minus_x);

// Manifold of a variable: sizes, and the retraction by a tangent vector with its inverse.
struct VariableType {
  int ambient_size = 0;
  int tangent_size = 0;
  PlusFunction plus = nullptr;
  MinusFunction minus = nullptr;
};

constexpr int kMaxAmbientSize = 9;

const VariableType& PoseVariable();    // 7 -> 6: poses of frames, extrinsics of cameras
const VariableType& MotionVariable();  // 9, vector space
const VariableType& ScalarVariable();  // 1, vector space: time offset
// 3, vector space: image point and inverse depth in the host; the inverse depth stays positive.
const VariableType& PointVariable();
// 8, vector space: camera intrinsics; focal lengths stay positive.
const VariableType& IntrinsicsVariable();
// 2, vector space: scale and delay of a depth stream (geometry/depth_stream.h).
const VariableType& DepthStreamVariable();
const VariableType& LineVariable();  // 5 -> 4: orthonormal representation (geometry/plucker.h)

const VariableType& VariableTypeOf(BlockKind kind);

// A variable of an optimization problem. The values are owned by the caller.
struct Variable {
  BlockId id;
  double* values = nullptr;
  bool constant = false;
  // Linearization point (first-estimate Jacobians, [Huang2010]); null: the current values.
  const double* linearization = nullptr;

  const VariableType& type() const { return VariableTypeOf(id.kind); }
};

}  // namespace plm_vins
