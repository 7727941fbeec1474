// SPDX-License-Identifier: BSD-3-Clause
// Runs the back end as the nodelet plm_vins/VinsEstimator.
#include <pluginlib/class_list_macros.hpp>

#include "common/ros/nodelet_of.h"
#include "vins_estimator/ros/estimator_node.h"

namespace plm_vins {
using VinsEstimatorNodelet = NodeletOf<&MakeEstimatorNode>;
}  // namespace plm_vins

PLUGINLIB_EXPORT_CLASS(plm_vins::VinsEstimatorNodelet, nodelet::Nodelet)
