// SPDX-License-Identifier: BSD-3-Clause
// Keyframes of a camera that flies twice along a wall of points and lines.
#pragma once

#include <memory>
#include <vector>

#include "common/camera/camera_model.h"
#include "pose_graph/keyframes/keyframe.h"
#include "simulator/random.h"

namespace plm_vins::testing {

constexpr double kFocalLength = 460;  // [px]

inline std::shared_ptr<const CameraModel> SimpleCamera(double focal_length = kFocalLength) {
  CameraParameters parameters;
  parameters.width = 752;
  parameters.height = 480;
  parameters.fx = parameters.fy = focal_length;
  parameters.cx = 376;
  parameters.cy = 240;
  return CameraModel::Create(parameters);
}

inline Descriptor RandomDescriptor(simulator::Random* random) {
  Descriptor descriptor = {};
  for (uint64_t& word : descriptor) {
    for (int bit = 0; bit < 64; ++bit) word = word << 1 | (random->Uniform(0, 1) < 0.5 ? 1 : 0);
  }
  return descriptor;
}

inline Descriptor WithFlippedBits(Descriptor descriptor, int count, simulator::Random* random) {
  for (int i = 0; i < count; ++i) {
    const int bit = static_cast<int>(random->Uniform(0, kDescriptorBits - 1e-9));
    descriptor[bit / 64] ^= uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

struct WallPoint {
  Eigen::Vector3d p_W;
  Descriptor descriptor;
};

// The landmarks of the scene, ahead along x.
struct Wall {
  explicit Wall(uint64_t seed = 1, int point_count = 150) {
    simulator::Random random(seed);
    for (int i = 0; i < point_count; ++i) {
      const Eigen::Vector3d p_W(random.Uniform(3, 8), random.Uniform(-4, 4), random.Uniform(-2, 2));
      points.push_back({p_W, RandomDescriptor(&random)});
    }
    for (int i = 0; i < 12; ++i) {
      const double y = -3 + 0.5 * i;
      lines.push_back({{5, y, -1}, {5 + 0.1 * i, y, 1}});
    }
  }

  std::vector<WallPoint> points;
  std::vector<SpaceSegment> lines;
};

struct VisitOptions {
  LevelTransform T_O_W;  // error of odometry: pose of the true world in O
  int world = 0;
  int64_t first_track = 0;            // tracks differ between visits
  double noise = 0.3 / kFocalLength;  // of corners (normalized)
  int flipped_bits = 10;              // of a descriptor
  bool with_lines = true;
  uint64_t seed = 2;
};

// Camera that looks along x of the body, which has z up.
inline Rigid3d LookingAhead() {
  Eigen::Matrix3d R_B_C;
  R_B_C << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {Eigen::Quaterniond(R_B_C), {0.1, 0, 0.05}};
}

// Returns the keyframe of the wall from T_W_B.
inline Keyframe Visit(const Wall& wall, const CameraModel& camera, const Rigid3d& T_W_B,
                      int64_t t_ns, const VisitOptions& options) {
  simulator::Random random(options.seed + static_cast<uint64_t>(t_ns));
  Keyframe keyframe;
  keyframe.t_ns = t_ns;
  keyframe.world = options.world;
  keyframe.T_O_B = options.T_O_W.ToRigid() * T_W_B;
  keyframe.T_B_C = {LookingAhead()};
  const Rigid3d T_C_W = (T_W_B * keyframe.T_B_C[0]).Inverse();
  for (size_t i = 0; i < wall.points.size(); ++i) {
    const Eigen::Vector3d p_C = T_C_W * wall.points[i].p_W;
    const auto uv_px = camera.Project(p_C);
    if (!uv_px || !camera.IsInImage(*uv_px)) continue;
    DescribedCorner& corner = keyframe.corners.emplace_back();
    corner.track = options.first_track + static_cast<int64_t>(i);
    corner.uv_px = uv_px->cast<float>();
    const Eigen::Vector2d noise(options.noise * random.Normal(), options.noise * random.Normal());
    corner.xy = (p_C.hnormalized() + noise).cast<float>();
    corner.p_O = (options.T_O_W * wall.points[i].p_W).cast<float>();
    corner.descriptor = WithFlippedBits(wall.points[i].descriptor, options.flipped_bits, &random);
  }
  for (size_t i = 0; options.with_lines && i < wall.lines.size(); ++i) {
    const SpaceSegment& line = wall.lines[i];
    TrackedSegment& segment = keyframe.segments.emplace_back();
    segment.observation.id = options.first_track + static_cast<int64_t>(i);
    segment.observation.start = (T_C_W * line.start_O).hnormalized();
    segment.observation.end = (T_C_W * line.end_O).hnormalized();
    segment.landmark = {options.T_O_W * line.start_O, options.T_O_W * line.end_O};
  }
  return keyframe;
}

}  // namespace plm_vins::testing
