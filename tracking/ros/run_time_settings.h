// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include <boost/thread/recursive_mutex.hpp>
#include <functional>

namespace plm_vins {

// Settings that rqt_reconfigure and dynparam can change while a node runs. `Settings` is generated
// from a file in cfg/. The initial values come from the configuration file: values of an earlier
// run on the parameter server are overwritten. `apply` is called at once and after each change, in
// a callback of `private_node`'s queue.
template <typename Settings>
class RunTimeSettings {
 public:
  RunTimeSettings(const Settings& initial, const ros::NodeHandle& private_node,
                  const std::function<void(const Settings&)>& apply)
      : server_(mutex_, private_node) {
    server_.setConfigDefault(initial);
    server_.updateConfig(initial);
    server_.setCallback([apply](const Settings& settings, uint32_t) { apply(settings); });
  }

 private:
  boost::recursive_mutex mutex_;  // guards server_
  dynamic_reconfigure::Server<Settings> server_;
};

}  // namespace plm_vins
