// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/estimator_node.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/ros/geometry_conversion.h"
#include "common/ros/msg_conversion.h"
#include "common/ros/parameter.h"

namespace plm_vins {
namespace {

constexpr int kSubscriberQueue = 2000;
// Topics in the node's namespace, so that each robot may have its own.
constexpr char kPointTopic[] = "feature_tracker/feature";
constexpr char kLineTopic[] = "linefeature_tracker/linefeature";
constexpr char kRestartTopic[] = "feature_tracker/restart";
constexpr char kInternalError[] = "internal error, see the log";
constexpr size_t kQueueCapacity = 5000;  // inputs, most of them IMU samples
// IMU samples are processed in batches while no image waits for them: waking a thread is more
// expensive than a sample.
constexpr size_t kImuBatch = 20;
constexpr double kTransformCheck = 5;  // [s] of own transforms
constexpr double kMaxWait = 0.5;       // [s]: images that wait longer are dropped

std::string FolderOf(const std::string& file) {
  return std::filesystem::path(file).parent_path().string();
}

template <typename... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <typename... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

EstimatorNode::EstimatorNode(const Config& config, const ros::NodeHandle& node,
                             const ros::NodeHandle& private_node)
    : node_(node),
      private_node_(private_node),
      config_(config),
      queue_(kQueueCapacity),
      propagation_(config, private_node_),
      calibration_(config),
      file_at_end_(TrajectoryFile("")),
      diagnostics_(config.sensor.imu_noise, node_.resolveName(config.sensor.imu_topic),
                   node_.resolveName(kPointTopic), node_.resolveName(kLineTopic)),
      stage_(config, kMaxWait),
      publisher_(config.output, static_cast<int>(config.sensor.cameras.size()), private_node_),
      diagnostics_updater_(node, private_node, private_node.getNamespace()) {
  WarnWithoutFileAtEnd();
  WarnWithoutCalibrationAtEnd();
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  subscribers_ = {
      in_place_.Receiver(node_).subscribe(config_.sensor.imu_topic, kSubscriberQueue,
                                          &EstimatorNode::AddImu, this, no_delay),
      node_.subscribe(kPointTopic, kSubscriberQueue, &EstimatorNode::AddPoints, this, no_delay),
      node_.subscribe(kRestartTopic, 10, &EstimatorNode::Restart, this, no_delay)};
  if (config_.use_lines) {
    subscribers_.push_back(
        node_.subscribe(kLineTopic, kSubscriberQueue, &EstimatorNode::AddLines, this, no_delay));
  }
  if (config_.output.publish_tf) {
    transforms_ = node_.subscribe("/tf", kSubscriberQueue, &EstimatorNode::CheckTransforms, this);
  }
  services_ = {
      private_node_.advertiseService("reset", &EstimatorNode::Reset, this),
      private_node_.advertiseService("save_trajectory", &EstimatorNode::SaveTrajectory, this)};
  diagnostics_updater_.setHardwareID("none");
  diagnostics_updater_.add("odometry", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    diagnostics_.Report(queue_.size(), &status);
  });
  diagnostics_timer_ =
      node_.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) {
        silence_.Check(node_.resolveName(config_.sensor.imu_topic), "sensor_msgs/Imu",
                       diagnostics_.imu());
        diagnostics_updater_.force_update();
      });
  worker_ = std::thread(&EstimatorNode::Work, this);
}

EstimatorNode::~EstimatorNode() {
  try {
    Finish();
  } catch (const std::runtime_error& error) {
    std::cerr << error.what() << std::endl;  // the log of ROS is shut down by now
  }
}

void EstimatorNode::Finish() {
  if (!worker_.joinable()) return;
  queue_.Close();
  services_.clear();  // waits for a running service call, which writes the same files
  worker_.join();
  for (const std::string& line : report_.Lines(std::nullopt)) {
    std::cerr << private_node_.getNamespace() << ": " << line << std::endl;
  }
  if (!file_at_end_.empty() && !trajectory_.empty()) Save(file_at_end_);
}

void EstimatorNode::AddImu(const sensor_msgs::Imu& message) {
  const ImuSample sample = ToImuSample(message);
  diagnostics_.imu().Add(sample.t_ns);
  propagation_.AddImu(sample);
  if (!queue_.PushQuietly(sample)) ++imu_refused_;
  if (frames_wait_ || queue_.size() >= kImuBatch) queue_.Wake();
}

void EstimatorNode::AddPoints(const FeatureEvent& event) {
  diagnostics_.points().Add(ToNanoseconds(event.getMessage()->header.stamp));
  try {
    int64_t left_out = 0;
    PointFrame frame = ToPointFrame(*event.getMessage(), &left_out);
    diagnostics_.CountLeftOut(left_out);
    RestoreIds(event, kPointTopic, &frame.points, &point_source_);
    if (!HasVelocities(*event.getMessage())) velocities_.Fill(&frame);
    queue_.Push(std::move(frame));
  } catch (const std::exception& error) {
    diagnostics_.CountMalformed(error.what());
  }
  callback_warner_.Check(diagnostics_.FeatureDrops());
}

void EstimatorNode::AddLines(const FeatureEvent& event) {
  diagnostics_.lines().Add(ToNanoseconds(event.getMessage()->header.stamp));
  try {
    int64_t left_out = 0;
    LineFrame frame = ToLineFrame(*event.getMessage(), &left_out);
    diagnostics_.CountLeftOut(left_out);
    RestoreIds(event, kLineTopic, &frame.lines, &line_source_);
    queue_.Push(std::move(frame));
  } catch (const std::exception& error) {
    diagnostics_.CountMalformed(error.what());
  }
  callback_warner_.Check(diagnostics_.FeatureDrops());
}

// Restores unique ids: a tracker that was restarted counts from zero again.
template <typename Observation>
void EstimatorNode::RestoreIds(const FeatureEvent& event, const char* topic,
                               std::vector<Observation>* observations, FeatureSource* source) {
  if (source->publisher.HasChanged(0, event.getConnectionHeaderPtr())) {
    source->ids.BeginTracker();
    if (source->turns.AddChange(ros::WallTime::now().toSec())) {
      ROS_WARN_STREAM_THROTTLE(
          10.0,
          "several publishers alternate on "
              << node_.resolveName(topic)
              << ", so that no feature track lasts: stop all but one (rostopic info lists them); "
                 "if a bag has features, play only its images and IMU (rosbag play FILE --topics "
              << node_.resolveName(config_.sensor.cameras[0].image_topic) << " "
              << node_.resolveName(config_.sensor.imu_topic) << ")");
    }
  }
  for (Observation& observation : *observations) {
    observation.id = source->ids.Restore(observation.id);
  }
}

void EstimatorNode::Restart(const std_msgs::Bool& message) {
  if (message.data) queue_.Push(ResetCommand{"requested on " + node_.resolveName(kRestartTopic)});
}

// The later one of two publishers sees the other, so that a short look suffices.
void EstimatorNode::CheckTransforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
  const OutputConfig& frames = config_.output;
  const std::string& frame = frames.base_frame.empty() ? frames.body_frame : frames.base_frame;
  const auto& transforms = event.getMessage()->transforms;
  if (std::none_of(transforms.begin(), transforms.end(),
                   [&](const auto& transform) { return transform.child_frame_id == frame; })) {
    return;
  }
  const ros::WallTime now = ros::WallTime::now();
  if (event.getPublisherName() != ros::this_node::getName()) {
    ROS_WARN_STREAM(
        event.getPublisherName()
        << " also publishes the tf frame " << frame
        << ": stop one of the two, or set publish_tf: 0 or other frames for one of them");
    transforms_.shutdown();
  } else if (!first_own_transform_) {
    first_own_transform_ = now;
  } else if (now - *first_own_transform_ > ros::WallDuration(kTransformCheck)) {
    transforms_.shutdown();
  }
}

bool EstimatorNode::Reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  queue_.Push(ResetCommand{"reset by service"});
  response.success = true;
  response.message = "restarting with the next image";
  return true;
}

bool EstimatorNode::SaveTrajectory(std_srvs::Trigger::Request&,
                                   std_srvs::Trigger::Response& response) {
  try {
    response.message = Save(TrajectoryFile("trajectory.tum"));
    response.success = true;
  } catch (const std::runtime_error& error) {
    response.success = false;
    response.message = error.what();
  }
  return true;
}

std::string EstimatorNode::TrajectoryFile(const std::string& otherwise) const {
  const auto file = FindParameter<std::string>(private_node_, "trajectory_file").value_or("");
  return FullPath(file.empty() ? otherwise : file);
}

// Warns at the start, while the user can still react: at the end the trajectory would be lost.
void EstimatorNode::WarnWithoutFileAtEnd() const {
  if (file_at_end_.empty()) return;
  try {
    TrajectoryLog::CheckWritable(file_at_end_);
  } catch (const std::runtime_error& error) {
    ROS_WARN_STREAM(error.what() << "; the trajectory will be lost, unless "
                                 << private_node_.resolveName("save_trajectory")
                                 << " saves it to another trajectory_file");
  }
}

// Warns at the start that the configuration in use would be overwritten.
void EstimatorNode::WarnWithoutCalibrationAtEnd() const {
  if (file_at_end_.empty()) return;
  try {
    calibration_.CheckFolder(FolderOf(file_at_end_));
  } catch (const std::runtime_error& error) {
    ROS_WARN_STREAM(error.what());
  }
}

std::string EstimatorNode::Save(const std::string& trajectory_file) const {
  std::string saved =
      std::to_string(trajectory_.Save(trajectory_file)) + " poses saved to " + trajectory_file;
  try {
    calibration_.Save(FolderOf(trajectory_file));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(saved + ", but not the calibration: " + error.what());
  }
  return saved;
}

void EstimatorNode::Work() {
  while (auto input = queue_.Pop()) {
    if (!ros::ok()) return queue_.Close();  // a callback may be waiting for space in it
    const bool done = worker_errors_.Run([&] {
      Take(std::move(*input));
      TakeAllThatWaits();
      for (auto frame = stage_.Pop(); frame && ros::ok(); frame = stage_.Pop()) {
        Handle(*frame);
        ReportDrops();
        TakeAllThatWaits();
      }
    });
    if (!done) StartOver(kInternalError);
    ReportDrops();
    frames_wait_ = stage_.queued_frames() > 0;
  }
}

// Takes all inputs that arrived during an estimate, since they decide which image is next.
void EstimatorNode::TakeAllThatWaits() {
  for (size_t waiting = queue_.size(); waiting > 0; --waiting) {
    if (auto input = queue_.Pop()) Take(std::move(*input));
  }
}

void EstimatorNode::Take(Input input) {
  std::visit(Overloaded{[&](const ImuSample& sample) { stage_.AddImu(sample); },
                        [&](PointFrame& points) { stage_.AddPoints(std::move(points)); },
                        [&](LineFrame& lines) { stage_.AddLines(std::move(lines)); },
                        [&](const ResetCommand& reset) { StartOver(reset.reason); }},
             input);
}

void EstimatorNode::ReportDrops() {
  DropCounts drops = stage_.Drops();
  drops.push_back({"imu_refused_full", imu_refused_, ""});
  drops.push_back(worker_errors_.count());
  worker_warner_.Check(drops);
  LogFinding();
  diagnostics_.UpdateCounts(stage_, drops);
}

// The next image's output announces the new world frame.
void EstimatorNode::StartOver(const std::string& reason) {
  stage_.Reset(reason);
  propagation_.Clear();
  EstimatorOutput output;
  output.reason = reason;
  diagnostics_.Update(output, stage_.frames(), 0);
}

void EstimatorNode::Handle(const EstimatedFrame& frame) {
  const EstimatorOutput& output = frame.output;
  propagation_.SetEstimate(frame);
  publisher_.Publish(frame);
  if (output.restarted) trajectory_.BeginWorld(output.reason);
  if (output.has_pose) {
    trajectory_.Add(output.t_ns, output.state.T_W_B());
    calibration_.Set(output.calibration);
  }
  report_.Add(output);
  LogChanges(output);
  LogLines();
  diagnostics_.Update(output, stage_.frames(), propagation_.Age(output));
}

void EstimatorNode::LogChanges(const EstimatorOutput& output) {
  const std::string why = output.reason.empty() ? "" : ": " + output.reason;
  if (output.restarted) {
    ROS_WARN_STREAM("new world frame" << why);
  } else if (output.bridged) {
    ROS_INFO("tracking again in the previous world frame");
  } else if (output.status == EstimatorStatus::kLost) {
    ROS_WARN_STREAM("lost" << why);
  } else if (output.status != last_status_) {
    ROS_INFO_STREAM(ToString(output.status) << why);
  } else if (output.reason != last_reason_) {
    ROS_INFO_STREAM_THROTTLE(2.0, ToString(output.status) << why);
  }
  last_status_ = output.status;
  last_reason_ = output.reason;
}

void EstimatorNode::LogFinding() {
  const Finding& finding = stage_.InputFinding();
  if (finding.is_present && !had_finding_) ROS_WARN_STREAM(finding.text);
  had_finding_ = finding.is_present;
}

void EstimatorNode::LogLines() {
  const bool missing = stage_.lines_are_missing();
  if (missing == lines_were_missing_) return;
  lines_were_missing_ = missing;
  const std::string line_topic = node_.resolveName(kLineTopic);
  if (missing) {
    ROS_WARN("%s on %s: continuing with points only",
             stage_.lines_are_of_other_images() ? "line and point timestamps do not match"
                                                : "no lines arrive in time",
             line_topic.c_str());
  } else {
    ROS_INFO("lines arrive in time again on %s", line_topic.c_str());
  }
}

std::shared_ptr<void> MakeEstimatorNode(const Config& config, const ros::NodeHandle& node,
                                        const ros::NodeHandle& private_node) {
  return std::make_shared<EstimatorNode>(config, node, private_node);
}

}  // namespace plm_vins
