// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "common/streams/stamp_order.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// Assembles keyframes from parts that arrive separately in any order: images, pose, corners, lines.
// Parts are joined by equal timestamps, images of further cameras by timestamps that differ by at
// most `stamp_tolerance` [s] from that of camera 0. Lines and these images are optional: a keyframe
// waits for lines until the next keyframe is complete. Keeps the parts of the newest timestamps
// only (at least two seconds, at most 300 timestamps) and restarts after a permanent backward jump
// of the image timestamps, as when a recording is replayed. An image after a forward jump is
// dropped, since its timestamp may be wrong.
class KeyframeAssembly {
 public:
  explicit KeyframeAssembly(double stamp_tolerance)
      : tolerance_ns_(ToNanoseconds(stamp_tolerance)) {}

  void AddImage(int camera, const ImageSample& image);
  void AddPose(int64_t t_ns, const Rigid3d& T_O_B, const Eigen::Matrix<double, 6, 6>& covariance);
  void AddCorners(int64_t t_ns, std::vector<TrackedCorner> corners);
  void AddSegments(int64_t t_ns, std::vector<TrackedSegment> segments);

  // Returns the next keyframe in temporal order, or nullopt if none is complete yet.
  std::optional<OdometryFrame> Pop();

  void Clear();

  // Number of keyframes dropped because their image did not arrive in time.
  int64_t without_image() const { return without_image_; }

 private:
  struct Parts {
    OdometryFrame frame;
    bool has_pose = false;
    bool has_corners = false;
    bool has_segments = false;

    bool has_image() const { return !frame.images.empty(); }
    bool AreComplete() const { return has_image() && has_pose && has_corners; }
    bool LacksImage() const { return !has_image() && has_pose && has_corners; }
  };

  using Stamps = std::map<int64_t, Parts>;

  void AddImageOfFirst(const ImageSample& image);
  void TakeFurtherImages(OdometryFrame* frame);
  Parts& PartsAt(int64_t t_ns);
  bool HasTooMany() const;
  // Erases the range, counting keyframes that lack their image; returns `end`.
  Stamps::iterator Forget(Stamps::iterator begin, Stamps::iterator end);

  int64_t tolerance_ns_;
  Stamps parts_;
  std::map<int, std::deque<ImageSample>> further_images_;  // of cameras other than 0, oldest first
  StampOrder image_order_{kImageJumps};
  int64_t without_image_ = 0;
};

}  // namespace plm_vins
