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

// main() of every node: starts ROS under `name` once there is a master, and runs `body` until
// shutdown. Threads and memory are used as by SetUpProcess(). Returns the exit code: 0 after
// SIGINT or SIGTERM; 1 where `body` threw, each line of what it says being a fatal log line, and
// where ROS refuses a name among the arguments.
int RunNode(int argc, char** argv, const std::string& name, const std::function<void()>& body);

// The same with the configuration of the file ~config_file, in which ~set/KEY replace scalar
// keys. Returns 1 also where that has problems.
int RunNode(int argc, char** argv, const std::string& name,
            const std::function<void(const Config&)>& body);

// Calls the callbacks of the global queue until ROS has shut down. Warns where the time is to come
// from /clock, and does not.
void Spin();

// Runs what must not end a node, whatever came in: an exception is logged (not all of them where
// there are many) and counted. For any threads.
class ErrorCounter {
 public:
  // False where `body` threw.
  bool Run(const std::function<void()>& body);

  DropCount count() const;

 private:
  mutable std::mutex mutex_;  // guards what follows
  DropCount errors_{"internal_errors", 0, ""};
};

// Warns when a kind of unusable input turns up for the first time.
class DropWarner {
 public:
  void Check(const DropCounts& counts);

 private:
  std::set<std::string> warned_;
};

}  // namespace plm_vins
