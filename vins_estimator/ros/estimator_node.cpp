// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/estimator_node.h"

#include <ros/spinner.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "common/ros/msg_conversion.h"

namespace plm_vins {
namespace {

constexpr int kSubscriberQueue = 2000;
constexpr char kLineTopic[] = "/linefeature_tracker/linefeature";
constexpr size_t kQueueCapacity = 5000;  // about 25 s of input; then the subscribers' queues fill

template <typename... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <typename... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

EstimatorNode::EstimatorNode(const Config& config)
    : config_(config),
      queue_(kQueueCapacity),
      propagation_(config, private_node_),
      stage_(config),
      publisher_(config.output, private_node_) {
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  subscribers_ = {
      node_.subscribe(config_.sensor.imu_topic, kSubscriberQueue, &EstimatorNode::AddImu, this,
                      no_delay),
      node_.subscribe("/feature_tracker/feature", kSubscriberQueue, &EstimatorNode::AddPoints, this,
                      no_delay),
      node_.subscribe("/feature_tracker/restart", 10, &EstimatorNode::Restart, this, no_delay)};
  if (config_.use_lines) {
    subscribers_.push_back(
        node_.subscribe(kLineTopic, kSubscriberQueue, &EstimatorNode::AddLines, this, no_delay));
  }
  services_ = {
      private_node_.advertiseService("reset", &EstimatorNode::Reset, this),
      private_node_.advertiseService("save_trajectory", &EstimatorNode::SaveTrajectory, this)};
  diagnostics_.setHardwareID("none");
  diagnostics_.add("odometry", this, &EstimatorNode::ReportStatus);
  diagnostics_timer_ = node_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  worker_ = std::thread(&EstimatorNode::Work, this);
}

EstimatorNode::~EstimatorNode() {
  queue_.Close();
  worker_.join();
}

void EstimatorNode::AddImu(const sensor_msgs::Imu& message) {
  const ImuSample sample = ToImuSample(message);
  propagation_.AddImu(sample);
  queue_.Push(sample);
}

void EstimatorNode::AddPoints(const FeatureEvent& event) {
  try {
    PointFrame frame = ToPointFrame(*event.getMessage());
    RestoreIds(event.getConnectionHeaderPtr(), &frame.points, &point_source_);
    queue_.Push(std::move(frame));
  } catch (const std::invalid_argument& error) {
    CountMalformed(error.what());
  }
}

void EstimatorNode::AddLines(const FeatureEvent& event) {
  try {
    LineFrame frame = ToLineFrame(*event.getMessage());
    RestoreIds(event.getConnectionHeaderPtr(), &frame.lines, &line_source_);
    queue_.Push(std::move(frame));
  } catch (const std::invalid_argument& error) {
    CountMalformed(error.what());
  }
}

// A tracker that was started again comes with a connection of its own.
template <typename Observation>
void EstimatorNode::RestoreIds(const boost::shared_ptr<ros::M_string>& connection,
                               std::vector<Observation>* observations, FeatureSource* source) {
  if (source->connection != connection) {
    source->connection = connection;
    source->ids.BeginTracker();
  }
  for (Observation& observation : *observations) {
    observation.id = source->ids.Restore(observation.id);
  }
}

void EstimatorNode::CountMalformed(const std::string& what) {
  callback_warner_.Check({{"feature_messages_malformed", ++malformed_messages_, what}});
}

void EstimatorNode::Restart(const std_msgs::Bool& message) {
  if (!message.data) return;
  ROS_WARN("restart: the images' stamps jumped back");
  queue_.Push(ResetCommand());
}

bool EstimatorNode::Reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  ROS_INFO("reset by service");
  queue_.Push(ResetCommand());
  response.success = true;
  response.message = "starting over with the next image";
  return true;
}

bool EstimatorNode::SaveTrajectory(std_srvs::Trigger::Request&,
                                   std_srvs::Trigger::Response& response) {
  const auto file = std::filesystem::absolute(
      private_node_.param<std::string>("trajectory_file", "trajectory.tum"));
  try {
    const size_t poses = trajectory_.Save(file.string());
    response.success = true;
    response.message = std::to_string(poses) + " poses saved to " + file.string();
  } catch (const std::runtime_error& error) {
    response.success = false;
    response.message = error.what();
  }
  return true;
}

void EstimatorNode::Work() {
  while (auto input = queue_.Pop()) {
    if (!ros::ok()) return;
    Process(std::move(*input));
  }
}

void EstimatorNode::Process(Input input) {
  std::visit(Overloaded{[&](const ImuSample& sample) { stage_.AddImu(sample); },
                        [&](PointFrame& points) { stage_.AddPoints(std::move(points)); },
                        [&](LineFrame& lines) { stage_.AddLines(std::move(lines)); },
                        [&](const ResetCommand&) { StartOver(); }},
             input);
  while (const auto frame = stage_.Pop()) Handle(*frame);
}

void EstimatorNode::StartOver() {
  stage_.Reset();
  propagation_.Clear();
  trajectory_.Clear();
  publisher_.Clear();
  EstimatorOutput output;
  output.reason = "reset, waiting for images";
  LogChanges(output);
  UpdateStatus(output);
}

void EstimatorNode::Handle(const EstimatedFrame& frame) {
  const EstimatorOutput& output = frame.output;
  propagation_.SetEstimate(output);
  publisher_.Publish(frame);
  if (output.restarted) trajectory_.Clear();
  if (output.has_pose) trajectory_.Add(output.t_ns, output.state.T_W_B());
  LogChanges(output);
  LogLines();
  ++frames_;
  UpdateStatus(output);
}

void EstimatorNode::LogChanges(const EstimatorOutput& output) {
  const std::string why = output.reason.empty() ? "" : ": " + output.reason;
  if (output.restarted) {
    ROS_WARN_STREAM("the world frame starts anew" << why);
  } else if (output.status != last_status_) {
    ROS_INFO_STREAM(ToString(output.status) << why);
  } else if (output.reason != last_reason_) {
    ROS_INFO_STREAM_THROTTLE(2.0, ToString(output.status) << why);
  }
  last_status_ = output.status;
  last_reason_ = output.reason;
}

void EstimatorNode::LogLines() {
  const bool missing = stage_.lines_are_missing();
  if (missing && !lines_were_missing_) {
    ROS_WARN("no lines come in time on %s: going on with points alone", kLineTopic);
  } else if (!missing && lines_were_missing_) {
    ROS_INFO("lines come in time again on %s", kLineTopic);
  }
  lines_were_missing_ = missing;
}

void EstimatorNode::UpdateStatus(const EstimatorOutput& output) {
  worker_warner_.Check(ToDropCounts(stage_.statistics()));
  const std::lock_guard<std::mutex> lock(status_mutex_);
  status_ = {output.status,        output.reason, output.counts,
             output.timings.total, frames_,       stage_.lines_are_missing(),
             stage_.statistics()};
}

void EstimatorNode::ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::lock_guard<std::mutex> lock(status_mutex_);
  const bool tracking = status_.status == EstimatorStatus::kTracking;
  const std::string why = status_.reason.empty() ? "" : ": " + status_.reason;
  status.summary(tracking ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 status_.frames == 0 ? "no usable image yet" : ToString(status_.status) + why);
  if (status_.lines_are_missing) {
    status.mergeSummary(DiagnosticStatus::WARN,
                        std::string("points alone: no lines come in time on ") + kLineTopic);
  }
  status.add("frames", status_.frames);
  status.add("points_observed", status_.counts.points_observed);
  status.add("points_in_window", status_.counts.points_in_window);
  status.add("lines_observed", status_.counts.lines_observed);
  status.add("lines_in_window", status_.counts.lines_in_window);
  status.add("frames_without_lines", status_.sync.frames_without_lines);
  status.add("lines_without_points", status_.sync.lines_without_points);
  status.add("estimator_ms", status_.estimator_ms);
  status.add("queued", queue_.size());
  status.add("feature_messages_malformed", malformed_messages_);
  for (const DropCount& drop : ToDropCounts(status_.sync)) status.add(drop.cause, drop.count);
}

}  // namespace plm_vins

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "vins_estimator", [](const plm_vins::Config& config) {
    const plm_vins::EstimatorNode node(config);
    ros::spin();
  });
}
