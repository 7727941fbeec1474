// SPDX-License-Identifier: BSD-3-Clause
// A nodelet manager, like that of the package nodelet, that runs all parts in one process and
// configures threads and memory as the nodes do. It loads the nodelets in ~nodelets (NAME: TYPE;
// names are relative to the manager's namespace) itself, without a loader process for each of them.
// If one cannot be loaded, the manager exits.
#include <nodelet/loader.h>
#include <ros/node_handle.h>

#include <map>
#include <stdexcept>
#include <string>

#include "common/ros/node_setup.h"
#include "common/ros/parameter.h"

namespace {

using TypesByName = std::map<std::string, std::string>;

void LoadNodelets(nodelet::Loader* manager) {
  const auto nodelets = plm_vins::FindParameter<TypesByName>(ros::NodeHandle("~"), "nodelets");
  if (!nodelets) return;
  for (const auto& [name, type] : *nodelets) {
    const std::string full_name = ros::NodeHandle().resolveName(name);
    if (!manager->load(full_name, type, {}, {})) {
      throw std::runtime_error("cannot load " + full_name + " (" + type + "); see the error above");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "vins_manager", [] {
    nodelet::Loader manager;
    LoadNodelets(&manager);
    plm_vins::Spin();
  });
}
