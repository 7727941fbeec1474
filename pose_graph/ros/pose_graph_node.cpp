// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/pose_graph_node.h"

#include <exception>
#include <stdexcept>
#include <utility>

#include "common/ros/camera_info_conversion.h"
#include "common/ros/image_conversion.h"
#include "common/ros/keyframe_conversion.h"
#include "common/ros/msg_conversion.h"
#include "common/stopwatch.h"
#include "pose_graph/output/map_file.h"
#include "pose_graph/ros/loop_drawing.h"
#include "pose_graph/ros/map_messages.h"

namespace plm_vins {
namespace {

constexpr char kEstimator[] = "/vins_estimator/";
constexpr int kQueue = 100;
constexpr size_t kWaitingKeyframes = 50;

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

// The message has the rotation's covariance about the axes of the world, we in the body.
Eigen::Matrix<double, 6, 6> CovarianceOf(const nav_msgs::Odometry& message, const Rigid3d& T_O_B) {
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Identity();
  J.bottomRightCorner<3, 3>() = T_O_B.R().transpose();
  const Eigen::Map<const RowMajor6d> covariance(message.pose.covariance.data());
  return J * covariance * J.transpose();
}

void CheckSameKind(const CameraParameters& ours, const CameraParameters& refined) {
  if (refined.model == ours.model && refined.width == ours.width && refined.height == ours.height) {
    return;
  }
  throw std::invalid_argument(std::string("the camera of ") + kEstimator +
                              "camera_info is not that of the configuration");
}

Rigid3d PoseOf(const nav_msgs::Odometry& message) {
  const auto& q = message.pose.pose.orientation;
  const auto& p = message.pose.pose.position;
  return {Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized(), {p.x, p.y, p.z}};
}

std::string MapFile(const Config& config, const ros::NodeHandle& private_node) {
  return private_node.param<std::string>("map_file", config.pose_graph.MapFile());
}

}  // namespace

PoseGraphNode::PoseGraphNode(const Config& config, const ros::NodeHandle& node,
                             const ros::NodeHandle& private_node)
    : node_(node),
      private_node_(private_node),
      config_(config),
      camera_(CameraModel::Create(config.sensor.camera)),
      map_file_(MapFile(config, private_node)),
      queue_(kWaitingKeyframes),
      odometry_publisher_(private_node_.advertise<nav_msgs::Odometry>("odometry", kQueue)),
      path_publisher_(private_node_.advertise<nav_msgs::Path>("path", 10, /*latch=*/true)),
      graph_publisher_(
          private_node_.advertise<visualization_msgs::MarkerArray>("graph", 10, /*latch=*/true)),
      match_publisher_(private_node_.advertise<sensor_msgs::Image>("match_image", 10)),
      diagnostics_(node, private_node, private_node.getNamespace()) {
  StartWith(config.pose_graph.load_previous ? LoadMap(map_file_) : KeyframeMap());
  diagnostics_.setHardwareID("none");
  diagnostics_.add("map", this, &PoseGraphNode::ReportStatus);
  worker_ = std::thread(&PoseGraphNode::Work, this);
  Subscribe();
}

PoseGraphNode::~PoseGraphNode() {
  subscribers_.clear();
  services_.clear();
  queue_.Close();
  worker_.join();
}

void PoseGraphNode::Subscribe() {
  const std::string estimator = kEstimator;
  subscribers_ = {
      node_.subscribe(config_.sensor.image_topic, kQueue, &PoseGraphNode::AddImage, this),
      node_.subscribe(estimator + "camera_info", kQueue, &PoseGraphNode::AddCamera, this),
      node_.subscribe(estimator + "keyframe_pose", kQueue, &PoseGraphNode::AddPose, this),
      node_.subscribe(estimator + "keyframe_point", kQueue, &PoseGraphNode::AddPoints, this),
      node_.subscribe(estimator + "keyframe_line", kQueue, &PoseGraphNode::AddLines, this),
      node_.subscribe(estimator + "odometry", kQueue, &PoseGraphNode::AddOdometry, this),
      node_.subscribe(estimator + "restart", kQueue, &PoseGraphNode::Restart, this)};
  services_ = {private_node_.advertiseService("save_map", &PoseGraphNode::SaveMapFile, this),
               private_node_.advertiseService("load_map", &PoseGraphNode::LoadMapFile, this),
               private_node_.advertiseService("reset", &PoseGraphNode::Reset, this)};
  diagnostics_timer_ = node_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
}

void PoseGraphNode::AddImage(const sensor_msgs::ImageConstPtr& message) {
  callback_errors_.Run([&] { assembly_.AddImage(ToImageSample(message)); });
  PassOn();
}

// Of another camera than ours, its rays would be nonsense. A model without rays throws.
void PoseGraphNode::AddCamera(const sensor_msgs::CameraInfo& message) {
  callback_errors_.Run([&] {
    const CameraParameters camera = ToCameraParameters(message);
    CameraModel::Create(camera);
    CheckSameKind(camera_->parameters(), camera);
    refined_camera_ = camera;
  });
}

void PoseGraphNode::AddPose(const nav_msgs::Odometry& message) {
  const Rigid3d T_O_B = PoseOf(message);
  assembly_.AddPose(ToNanoseconds(message.header.stamp), T_O_B, CovarianceOf(message, T_O_B));
  PassOn();
}

void PoseGraphNode::AddPoints(const sensor_msgs::PointCloud& message) {
  callback_errors_.Run(
      [&] { assembly_.AddCorners(ToNanoseconds(message.header.stamp), ToCorners(message)); });
  PassOn();
}

void PoseGraphNode::AddLines(const sensor_msgs::PointCloud& message) {
  callback_errors_.Run([&] {
    assembly_.AddSegments(ToNanoseconds(message.header.stamp), ToSegments(message),
                          ToManhattanFrame(message));
  });
  PassOn();
}

void PoseGraphNode::PassOn() {
  while (auto frame = assembly_.Pop()) {
    frame->T_B_C = config_.sensor.T_B_C;
    frame->camera = refined_camera_;
    frame->restarted = std::exchange(restarted_, false);
    queue_.Push(std::move(*frame));
  }
}

// Keyframes of before that wait for a part are of a world that is no more.
void PoseGraphNode::Restart(const std_msgs::Bool& message) {
  if (!message.data) return;
  assembly_.Clear();
  restarted_ = true;
  const std::lock_guard<std::mutex> lock(status_mutex_);
  status_.fix.reset();
}

void PoseGraphNode::AddOdometry(const nav_msgs::Odometry& message) {
  std::optional<MapFix> fix;
  {
    const std::lock_guard<std::mutex> lock(status_mutex_);
    fix = status_.fix;
  }
  if (!fix) return;
  const std::string& map_frame = config_.output.map_frame;
  odometry_publisher_.publish(ToMap(message, *fix, map_frame));
  if (!config_.output.publish_tf) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = message.header.stamp;
  transform.header.frame_id = map_frame;
  transform.child_frame_id = message.header.frame_id;
  transform.transform = ToTransform(fix->T_M_O.ToRigid());
  broadcaster_.sendTransform(transform);
}

bool PoseGraphNode::SaveMapFile(Trigger::Request&, Trigger::Response& response) {
  const std::lock_guard<std::mutex> lock(loops_mutex_);
  try {
    SaveMap(map_file_, loops_->map());
    response.success = true;
    response.message =
        std::to_string(loops_->map().CountKept()) + " keyframes saved to " + map_file_;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

bool PoseGraphNode::LoadMapFile(Trigger::Request&, Trigger::Response& response) {
  try {
    StartWith(LoadMap(map_file_));
    response.success = true;
    response.message = "starting in the map " + map_file_;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

bool PoseGraphNode::Reset(Trigger::Request&, Trigger::Response& response) {
  StartWith(KeyframeMap());
  response.success = true;
  response.message = "starting an empty map";
  return true;
}

void PoseGraphNode::StartWith(KeyframeMap map) {
  const std::lock_guard<std::mutex> lock(loops_mutex_);
  loops_ = std::make_unique<LoopCloser>(LoopCloserOptions(), camera_);
  loops_->SetMap(std::move(map));
  images_ = KeyframeImages();
  const std::lock_guard<std::mutex> status_lock(status_mutex_);
  status_ = Status();
  status_.keyframes = loops_->map().CountKept();
}

void PoseGraphNode::Work() {
  while (auto frame = queue_.Pop()) {
    worker_errors_.Run([&] {
      const std::lock_guard<std::mutex> lock(loops_mutex_);
      const Stopwatch stopwatch;
      const LoopClosure closure = loops_->Add(*frame);
      UpdateStatus(closure, stopwatch.Milliseconds());
      if (!closure.is_keyframe) return;
      Publish(*frame, closure);
      Remember(*frame);
    });
  }
}

void PoseGraphNode::UpdateStatus(const LoopClosure& closure, double milliseconds) {
  const std::lock_guard<std::mutex> lock(status_mutex_);
  status_.fix = closure.fix;
  status_.keyframes = loops_->map().CountKept();
  if (closure.is_keyframe) status_.keyframe_ms = milliseconds;
  for (const LoopCandidate& candidate : closure.candidates) {
    candidate.failed ? ++status_.refused[ToString(*candidate.failed)] : ++status_.loops;
  }
}

void PoseGraphNode::Publish(const OdometryFrame& frame, const LoopClosure& closure) {
  const std::string& map_frame = config_.output.map_frame;
  if (path_publisher_.getNumSubscribers() > 0) {
    path_publisher_.publish(ToPath(loops_->map(), map_frame));
  }
  if (graph_publisher_.getNumSubscribers() > 0) {
    graph_publisher_.publish(ToGraphMarkers(loops_->map(), frame.t_ns, map_frame));
  }
  if (closure.place && match_publisher_.getNumSubscribers() > 0) {
    const cv::Mat picture = DrawLoop(*camera_, closure.place->sightings,
                                     images_.Find(closure.place->earlier), frame.gray);
    match_publisher_.publish(ToMessage(picture, frame.t_ns, config_.output.camera_frame));
  }
}

// The newest keyframe is that of the frame. Thinning may have taken others away.
void PoseGraphNode::Remember(const OdometryFrame& frame) {
  const PoseGraph& graph = loops_->map().graph;
  images_.Add(graph.size() - 1, frame.gray);
  images_.Keep([&](int keyframe) { return graph.Has(keyframe); });
}

void PoseGraphNode::ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::lock_guard<std::mutex> lock(status_mutex_);
  if (status_.fix) {
    status.summary(DiagnosticStatus::OK, "located in the map");
  } else if (status_.keyframes == 0) {
    status.summary(DiagnosticStatus::OK, "waiting: no keyframe yet");
  } else {
    status.summary(DiagnosticStatus::WARN, "looking for the place in the map");
  }
  status.add("keyframes", status_.keyframes);
  status.add("loops", status_.loops);
  for (const auto& [gate, count] : status_.refused) status.add("refused_" + gate, count);
  status.add("keyframe_ms", status_.keyframe_ms);
  status.add("waiting_keyframes", queue_.size());
}

}  // namespace plm_vins
