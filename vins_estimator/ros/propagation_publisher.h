// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <mutex>

#include "common/config/config.h"
#include "vins_estimator/estimation_stage.h"
#include "vins_estimator/imu/imu_propagator.h"
#include "vins_estimator/ros/output_conversion.h"

namespace plm_vins {

// Publishes ~imu_propagate: the newest state, propagated to each IMU sample as it arrives. Its
// covariance is that of the image it starts from. Thread-safe: IMU samples and estimates may come
// from different threads.
class PropagationPublisher {
 public:
  PropagationPublisher(const Config& config, ros::NodeHandle private_node);

  void AddImu(const ImuSample& sample);
  void SetEstimate(const EstimatedFrame& frame);
  void Clear();

  // Returns the time from the image of `output` to the newest IMU sample [s]; zero without samples.
  double Age(const EstimatorOutput& output) const;

 private:
  OutputConfig frames_;
  ros::Publisher publisher_;
  mutable std::mutex mutex_;
  ImuPropagator propagator_;  // guarded by mutex_, as the following member
  StateCovariance covariance_;
};

}  // namespace plm_vins
