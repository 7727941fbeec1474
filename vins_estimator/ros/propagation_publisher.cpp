// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/propagation_publisher.h"

#include "common/measurements.h"

namespace plm_vins {

PropagationPublisher::PropagationPublisher(const Config& config, ros::NodeHandle private_node)
    : frames_(config.output),
      publisher_(private_node.advertise<nav_msgs::Odometry>("imu_propagate", 1000)),
      propagator_(Eigen::Vector3d(0, 0, -config.sensor.gravity_norm), config.sensor.imu) {}

void PropagationPublisher::AddImu(const ImuSample& sample) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto state = propagator_.Add(sample);
  if (!state || publisher_.getNumSubscribers() == 0) return;
  publisher_.publish(ToOdometry(*state, covariance_, propagator_.AngularVelocity(), frames_));
}

void PropagationPublisher::SetEstimate(const EstimatedFrame& frame) {
  const EstimatorOutput& output = frame.output;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!output.has_pose) return propagator_.Clear();
  propagator_.Reset(output.state, frame.imu_ns);
  covariance_ = CovarianceOf(frame);
}

void PropagationPublisher::Clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  propagator_.Clear();
}

double PropagationPublisher::Age(const EstimatorOutput& output) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto newest_ns = propagator_.newest_ns();
  return newest_ns ? ToSeconds(*newest_ns - output.t_ns) - output.calibration.td : 0;
}

}  // namespace plm_vins
