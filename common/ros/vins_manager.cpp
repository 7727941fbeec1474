// SPDX-License-Identifier: BSD-3-Clause
// One process for all parts: a manager of nodelets, as that of the package nodelet, which uses
// threads and memory as our nodes do. The nodelets that ~nodelets names (NAME: TYPE; names are
// relative to the manager's namespace) are there from the beginning, without a process that loads
// each of them; where one cannot be loaded, the manager ends.
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
      throw std::runtime_error("cannot load " + full_name + " (" + type + "), see above");
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
