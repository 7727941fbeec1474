// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/output_publisher.h"

#include <geometry_msgs/PoseStamped.h>
#include <std_msgs/Bool.h>

#include <string>

#include "common/append.h"
#include "common/ros/camera_info_conversion.h"
#include "common/ros/geometry_conversion.h"
#include "common/ros/keyframe_conversion.h"
#include "common/ros/names.h"
#include "common/ros/publish_if_wanted.h"
#include "vins_estimator/output/placed_features.h"
#include "vins_estimator/ros/output_conversion.h"

namespace plm_vins {
namespace {

constexpr int kQueue = 1000;
constexpr double kPathStep = 0.02;      // [m] between poses of the path
constexpr size_t kMaxPathPoses = 5000;  // if exceeded, every second pose is removed
// Share of new poses after which the path is published again: no visible lag if the whole path is
// in view, and constant bandwidth however long the path is.
constexpr double kNewPathShare = 0.01;
constexpr int64_t kHistoryInterval_ns = 1'000'000'000;

void RemoveEverySecond(std::vector<geometry_msgs::PoseStamped>* poses) {
  for (size_t i = 0; 2 * i < poses->size(); ++i) (*poses)[i] = (*poses)[2 * i];
  poses->resize((poses->size() + 1) / 2);
}

double Distance(const geometry_msgs::Point& a, const geometry_msgs::Point& b) {
  return Eigen::Vector3d(a.x - b.x, a.y - b.y, a.z - b.z).norm();
}

}  // namespace

OutputPublisher::OutputPublisher(const OutputConfig& frames, int cameras,
                                 ros::NodeHandle private_node)
    : frames_(frames),
      line_history_(frames.world_frame),
      restart_(private_node.advertise<std_msgs::Bool>("restart", 10)),
      odometry_(private_node.advertise<nav_msgs::Odometry>("odometry", kQueue)),
      path_publisher_(private_node.advertise<nav_msgs::Path>("path", 10, /*latch=*/true)),
      camera_pose_(private_node.advertise<nav_msgs::Odometry>("camera_pose", kQueue)),
      key_poses_(private_node.advertise<visualization_msgs::Marker>("key_poses", kQueue)),
      point_cloud_(private_node.advertise<sensor_msgs::PointCloud>("point_cloud", kQueue)),
      history_cloud_(private_node.advertise<sensor_msgs::PointCloud>("history_cloud", kQueue)),
      lines_cloud_(private_node.advertise<visualization_msgs::Marker>("lines_cloud", kQueue)),
      history_lines_cloud_(AdvertiseLineHistory(private_node)),
      camera_pose_visual_(
          private_node.advertise<visualization_msgs::MarkerArray>("camera_pose_visual", kQueue)),
      keyframe_line_(private_node.advertise<sensor_msgs::PointCloud>("keyframe_line", kQueue)),
      keyframe_point_(private_node.advertise<sensor_msgs::PointCloud>("keyframe_point", kQueue)),
      keyframe_pose_(private_node.advertise<nav_msgs::Odometry>("keyframe_pose", kQueue)) {
  for (int camera = 0; camera < cameras; ++camera) {
    extrinsics_.push_back(
        private_node.advertise<nav_msgs::Odometry>(NameOfCamera("extrinsic", camera), kQueue));
    camera_infos_.push_back(
        private_node.advertise<sensor_msgs::CameraInfo>(NameOfCamera("camera_info", camera), 10));
  }
  if (frames.publish_tf && !frames.base_frame.empty()) {
    base_.emplace(frames.body_frame, frames.base_frame);
  }
}

// New subscribers get all lines; a latched topic would only send the last marker.
ros::Publisher OutputPublisher::AdvertiseLineHistory(ros::NodeHandle private_node) {
  return private_node.advertise<visualization_msgs::Marker>(
      "history_lines_cloud", kQueue, [this](const ros::SingleSubscriberPublisher& subscriber) {
        const std::lock_guard<std::mutex> lock(history_mutex_);
        for (const auto& marker : line_history_.All()) subscriber.publish(marker);
      });
}

void OutputPublisher::Publish(const EstimatedFrame& frame) {
  const EstimatorOutput& output = frame.output;
  if (output.restarted) {
    Clear();
    std_msgs::Bool restart;
    restart.data = true;
    restart_.publish(restart);
  }
  if (!output.has_pose) return;

  const int64_t t_ns = output.t_ns;
  const std::string& world = frames_.world_frame;
  const Rigid3d T_W_C = output.state.T_W_B() * output.calibration.cameras[0].T_B_C;
  odometry_.publish(ToOdometry(output.state, CovarianceOf(frame), frame.angular_velocity, frames_));
  PublishPath(output.state);
  PublishTransforms(output);
  PublishIfWanted(camera_pose_,
                  [&] { return ToOdometry(t_ns, T_W_C, world, frames_.camera_frame); });
  for (size_t i = 0; i < extrinsics_.size(); ++i) {
    PublishIfWanted(extrinsics_[i], [&] {
      return ToOdometry(t_ns, output.calibration.cameras[i].T_B_C, frames_.body_frame,
                        CameraFrame(i));
    });
  }
  PublishIfWanted(key_poses_, [&] { return ToKeyPoses(output.window, t_ns, world); });
  PublishIfWanted(point_cloud_, [&] { return ToPointCloud(output.points, t_ns, world); });
  PublishIfWanted(lines_cloud_, [&] { return ToLineMarker(output.lines, t_ns, world, "lines"); });
  if (output.keyframe) PublishKeyframe(frame);
  PublishHistory(output);
  PublishIfWanted(camera_pose_visual_, [&] { return ToCameraVisual(T_W_C, t_ns, world); });
}

void OutputPublisher::Clear() {
  world_ = {};
  const std::lock_guard<std::mutex> lock(history_mutex_);
  visualization_msgs::Marker nothing = line_history_.Clear();
  PublishIfWanted(history_lines_cloud_, [&] { return nothing; });
}

// Publishes the newest image, which arrives together with a keyframe. The pose is last, so that a
// subscriber that has it need not wait for the other messages.
void OutputPublisher::PublishKeyframe(const EstimatedFrame& frame) {
  const EstimatorOutput& output = frame.output;
  const std::string& world = frames_.world_frame;
  for (size_t i = 0; i < camera_infos_.size(); ++i) {
    PublishIfWanted(camera_infos_[i], [&] {
      return ToCameraInfo(output.calibration.cameras[i].parameters, output.t_ns, CameraFrame(i));
    });
  }
  PublishIfWanted(keyframe_line_, [&] {
    return ToKeyframeLines(PlaceSegments(frame.lines, output.lines), output.t_ns, world);
  });
  PublishIfWanted(keyframe_point_, [&] {
    return ToKeyframePoints(PlaceCorners(frame.points, output.points), output.t_ns, world);
  });
  PublishIfWanted(keyframe_pose_, [&] {
    return ToOdometry(output.state, CovarianceOf(frame), frame.angular_velocity, frames_);
  });
}

// Publishes one message per interval, because displays store each message as a separate object.
void OutputPublisher::PublishHistory(const EstimatorOutput& output) {
  Append(output.departed_points, &world_.departed_points);
  Append(output.departed_lines, &world_.departed_lines);
  Append(output.absorbed_lines, &world_.absorbed_lines);
  if (output.t_ns - world_.history_ns < kHistoryInterval_ns) return;
  world_.history_ns = output.t_ns;
  PublishIfWanted(history_cloud_, [&] {
    return ToPointCloud(world_.departed_points, output.t_ns, frames_.world_frame);
  });
  PublishLineHistory(output.t_ns);
  world_.departed_points.clear();
  world_.departed_lines.clear();
  world_.absorbed_lines.clear();
}

void OutputPublisher::PublishLineHistory(int64_t t_ns) {
  const std::lock_guard<std::mutex> lock(history_mutex_);
  for (const auto& marker : line_history_.Add(world_.departed_lines, t_ns)) {
    PublishIfWanted(history_lines_cloud_, [&] { return marker; });
  }
  line_history_.Remove(world_.absorbed_lines);  // after Add(), which may add them
}

void OutputPublisher::PublishPath(const FrameState& state) {
  geometry_msgs::PoseStamped pose;
  pose.header = MakeHeader(state.t_ns, frames_.world_frame);
  pose.pose = ToPose(state.T_W_B());
  nav_msgs::Path& path = world_.path;
  const bool moved = path.poses.empty() ||
                     Distance(path.poses.back().pose.position, pose.pose.position) > kPathStep;
  if (!moved) return;
  if (path.poses.size() == kMaxPathPoses) RemoveEverySecond(&path.poses);
  path.poses.push_back(pose);
  path.header = pose.header;
  if (++world_.new_path_poses < kNewPathShare * static_cast<double>(path.poses.size())) return;
  world_.new_path_poses = 0;
  path_publisher_.publish(path);  // latched, as displays may be opened during a standstill
}

std::string OutputPublisher::CameraFrame(size_t camera) const {
  return NameOfCamera(frames_.camera_frame, static_cast<int>(camera));
}

void OutputPublisher::PublishTransforms(const EstimatorOutput& output) {
  if (!frames_.publish_tf) return;
  std::vector<geometry_msgs::TransformStamped> transforms = BodyTransforms(output);
  if (output.R_W_M) {
    const Rigid3d T_W_M(*output.R_W_M, Eigen::Vector3d::Zero());
    transforms.push_back(
        ToTransform(MakeHeader(output.t_ns, frames_.world_frame), frames_.manhattan_frame, T_W_M));
  }
  if (!transforms.empty()) broadcaster_.sendTransform(transforms);
}

std::vector<geometry_msgs::TransformStamped> OutputPublisher::BodyTransforms(
    const EstimatorOutput& output) {
  const std_msgs::Header in_world = MakeHeader(output.t_ns, frames_.world_frame);
  const std_msgs::Header in_body = MakeHeader(output.t_ns, frames_.body_frame);
  const Rigid3d T_W_B = output.state.T_W_B();
  if (!base_) {
    std::vector<geometry_msgs::TransformStamped> transforms = {
        ToTransform(in_world, frames_.body_frame, T_W_B)};
    const std::vector<CameraCalibration>& cameras = output.calibration.cameras;
    for (size_t i = 0; i < cameras.size(); ++i) {
      transforms.push_back(ToTransform(in_body, CameraFrame(i), cameras[i].T_B_C));
    }
    return transforms;
  }
  const auto T_body_base = base_->Locate();
  if (!T_body_base) return {};
  return {ToTransform(in_world, frames_.base_frame, T_W_B * *T_body_base)};
}

}  // namespace plm_vins
