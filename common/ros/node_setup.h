// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <mutex>
#include <set>
#include <string>

#include "common/config/config.h"
#include "common/streams/drop_counts.h"

namespace plm_vins {

// The main() of every node: starts ROS under `name` once there is a master, and runs `body` until
// shutdown. Configures threads and memory by SetUpProcess(). Returns the exit code: 0 after SIGINT
// or SIGTERM; 1 if `body` threw, with each line of its message logged as fatal, or if ROS rejects a
// name among the arguments.
int RunNode(int argc, char** argv, const std::string& name, const std::function<void()>& body);

// Runs `body` with the configuration of LoadNodeConfig(). Also returns 1 if the configuration has
// problems.
int RunNode(int argc, char** argv, const std::string& name,
            const std::function<void(const Config&)>& body);

// Returns `value`; if it is false, logs that the node is idle because of `key`.
bool IsNeeded(bool value, const char* key, const Config& config);

// Processes callbacks of the global queue until ROS has shut down. Warns if simulated time is
// configured but /clock is silent.
void Spin();

// Runs code whose exceptions must not terminate the node: logs (throttled) and counts them.
// Thread-safe.
class ErrorCounter {
 public:
  // Returns false if `body` threw.
  bool Run(const std::function<void()>& body);

  DropCount count() const;

 private:
  mutable std::mutex mutex_;  // guards the following member
  DropCount errors_{"internal_errors", 0, ""};
};

// Warns when a kind of unusable input occurs for the first time.
class DropWarner {
 public:
  void Check(const DropCounts& counts);

 private:
  std::set<std::string> warned_;
};

}  // namespace plm_vins
