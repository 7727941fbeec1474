// SPDX-License-Identifier: BSD-3-Clause
// Runs the tests of a program in a node that has the program's name.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <filesystem>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, std::filesystem::path(argv[0]).filename().string());
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
