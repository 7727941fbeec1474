// SPDX-License-Identifier: BSD-3-Clause
// One process for all parts: a manager of nodelets, as that of the package nodelet, which uses
// threads and memory as our nodes do.
#include <nodelet/loader.h>

#include "common/ros/node_setup.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "vins_manager", [] {
    const nodelet::Loader manager;
    plm_vins::Spin();
  });
}
