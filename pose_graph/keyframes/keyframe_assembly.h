// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/streams/backward_jump.h"
#include "common/streams/forward_jump.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// Puts keyframes together whose parts come one by one, in any order: image, pose, corners, lines.
// Equal stamps belong together. Lines may be missing: a keyframe does not wait for them longer than
// until the next one is complete. Keeps the parts of the newest stamps only, of two seconds at
// least but of 300 stamps at most, and begins anew where the stamps of images go back for good: a
// recording is played again. An image after a leap in time is dropped, as its stamp may be wrong.
class KeyframeAssembly {
 public:
  KeyframeAssembly();

  void AddImage(const ImageSample& image);
  void AddPose(int64_t t_ns, const Rigid3d& T_O_B, const Eigen::Matrix<double, 6, 6>& covariance);
  void AddCorners(int64_t t_ns, std::vector<TrackedCorner> corners);
  void AddSegments(int64_t t_ns, std::vector<TrackedSegment> segments,
                   const std::optional<Eigen::Quaterniond>& R_O_Manhattan);

  // The next keyframe in order of time, or nothing yet.
  std::optional<OdometryFrame> Pop();

  void Clear();

  // Those that had to go before their image came.
  int64_t without_image() const { return without_image_; }

 private:
  struct Parts {
    OdometryFrame frame;
    bool has_pose = false;
    bool has_corners = false;
    bool has_segments = false;

    bool AreComplete() const { return !frame.gray.empty() && has_pose && has_corners; }
    bool LacksImage() const { return frame.gray.empty() && has_pose && has_corners; }
  };

  using Stamps = std::map<int64_t, Parts>;

  Parts& PartsAt(int64_t t_ns);
  bool HasTooMany() const;
  // Counts those that lack their image; returns `end`.
  Stamps::iterator Forget(Stamps::iterator begin, Stamps::iterator end);

  Stamps parts_;
  std::optional<int64_t> image_ns_;  // stamp of the newest image
  BackwardJumpDetector jump_;
  ForwardJumpDetector leap_;
  int64_t without_image_ = 0;
};

}  // namespace plm_vins
