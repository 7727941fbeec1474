// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Bool.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "common/config/config.h"
#include "common/features/feature_ids.h"
#include "common/ros/in_place_queue.h"
#include "common/ros/node_setup.h"
#include "common/ros/publisher_watch.h"
#include "common/ros/silent_topic.h"
#include "common/streams/bounded_queue.h"
#include "vins_estimator/estimation_stage.h"
#include "vins_estimator/input/track_velocities.h"
#include "vins_estimator/output/run_report.h"
#include "vins_estimator/ros/calibration_log.h"
#include "vins_estimator/ros/estimator_diagnostics.h"
#include "vins_estimator/ros/output_publisher.h"
#include "vins_estimator/ros/propagation_publisher.h"
#include "vins_estimator/ros/trajectory_log.h"

namespace plm_vins {

// The back end under ROS, as a node or in a nodelet. The callbacks only queue the inputs and
// publish the state at IMU rate; a worker thread passes the inputs to the synchronous core in order
// of arrival. If the worker cannot keep up, images that have waited too long are dropped in favor
// of the newest one.
//
// Services: ~reset reinitializes; ~save_trajectory writes the poses so far to ~trajectory_file
// (default trajectory.tum in the node's working folder) and, if the calibration is refined,
// calibrated.yaml beside it. The node also saves both at the end if ~trajectory_file is set.
class EstimatorNode {
 public:
  EstimatorNode(const Config& config, const ros::NodeHandle& node,
                const ros::NodeHandle& private_node);
  ~EstimatorNode();

  // Ends the worker and saves the files. Throws std::runtime_error if one cannot be written; the
  // destructor, which finishes as well, prints the reason.
  void Finish();

 private:
  struct ResetCommand {
    std::string reason;
  };
  using Input = std::variant<ImuSample, PointFrame, LineFrame, ResetCommand>;
  using FeatureEvent = ros::MessageEvent<const sensor_msgs::PointCloud>;

  // State of one tracker's messages while it is connected.
  struct FeatureSource {
    PublisherWatch publisher{1};
    TurnsWatch turns;
    IdRestorer ids;
  };

  // Called in the thread that receives the samples. Never waits for space in the queue: a driver in
  // this process holds a lock of ROS meanwhile, without which the worker cannot publish.
  void AddImu(const sensor_msgs::Imu& message);

  // Called in the callback thread.
  void AddPoints(const FeatureEvent& event);
  void AddLines(const FeatureEvent& event);
  template <typename Observation>
  void RestoreIds(const FeatureEvent& event, const char* topic,
                  std::vector<Observation>* observations, FeatureSource* source);
  void Restart(const std_msgs::Bool& message);
  void CheckTransforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event);
  bool Reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool SaveTrajectory(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  // Returns the full path of ~trajectory_file; that of `otherwise` if it is empty or not set.
  std::string TrajectoryFile(const std::string& otherwise) const;
  void WarnWithoutFileAtEnd() const;
  void WarnWithoutCalibrationAtEnd() const;
  // Saves all files and returns a description; throws std::runtime_error if a file cannot be
  // written.
  std::string Save(const std::string& trajectory_file) const;

  // Called in the worker thread.
  void Work();
  void Take(Input input);
  void TakeAllThatWaits();
  void ReportDrops();
  void StartOver(const std::string& reason);
  void Handle(const EstimatedFrame& frame);
  void LogChanges(const EstimatorOutput& output);
  void LogFinding();
  void LogLines();

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  Config config_;

  BoundedQueue<Input> queue_;
  std::atomic<bool> frames_wait_ = false;  // images wait in the worker, for the IMU or for lines
  std::atomic<int64_t> imu_refused_ = 0;   // samples dropped because the queue was full
  PropagationPublisher propagation_;
  TrajectoryLog trajectory_;
  CalibrationLog calibration_;
  std::string file_at_end_;  // empty: nothing is saved
  EstimatorDiagnostics diagnostics_;
  FeatureSource point_source_;
  FeatureSource line_source_;
  TrackVelocities velocities_;
  DropWarner callback_warner_;

  // Used by the worker only.
  EstimationStage stage_;
  OutputPublisher publisher_;
  DropWarner worker_warner_;
  ErrorCounter worker_errors_;
  EstimatorStatus last_status_ = EstimatorStatus::kInitializing;
  std::string last_reason_;
  bool had_finding_ = false;
  RunReport report_;
  bool lines_were_missing_ = false;

  InPlaceQueue in_place_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber transforms_;  // until no other publisher of this node's transforms was found
  std::optional<ros::WallTime> first_own_transform_;
  std::vector<ros::ServiceServer> services_;
  SilenceWarner silence_;
  diagnostic_updater::Updater diagnostics_updater_;
  ros::WallTimer diagnostics_timer_;
  std::thread worker_;
};

std::shared_ptr<void> MakeEstimatorNode(const Config& config, const ros::NodeHandle& node,
                                        const ros::NodeHandle& private_node);

}  // namespace plm_vins
