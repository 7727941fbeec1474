#!/usr/bin/env bash
# Installs missing packages for building, testing and running with apt: on Debian 11 to 13, where
# they have the same names, or Ubuntu 20.04 with ROS Noetic. Usage: setup.sh [further package ...]
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
# shellcheck source=scripts/usage.sh
source "$root/scripts/usage.sh"

common_packages=(
  build-essential cmake curl libboost-dev libboost-program-options-dev libceres-dev
  libeigen3-dev libgmock-dev libgtest-dev libopencv-contrib-dev libopencv-dev libyaml-cpp-dev nlohmann-json3-dev
  python3-matplotlib python3-numpy python3-pil python3-yaml unzip)
optional_packages=(python3-plotly python3-tornado)  # for 3-D pages
debian_packages=(
  catkin libcv-bridge-dev libdiagnostic-updater-dev
  libgeometry-msgs-dev libimage-transport-dev
  libnav-msgs-dev libnodelet-dev libnodeletlib-dev libnodeletlib-tools librosbag-dev libroscpp-dev
  librostest-dev libsensor-msgs-dev libstd-msgs-dev libstd-srvs-dev libtf2-msgs-dev libtf2-ros-dev
  libvisualization-msgs-dev pluginlib-dev python3-diagnostic-msgs
  python3-nav-msgs python3-rosbag python3-roslaunch python3-rosnode python3-rosservice
  python3-rostest python3-rostopic python3-sensor-msgs python3-std-srvs python3-tf2-msgs
  python3-visualization-msgs rosbash rosout rviz tf2-tools)
noetic_packages=(
  ros-noetic-catkin ros-noetic-cv-bridge ros-noetic-diagnostic-updater
  ros-noetic-geometry-msgs ros-noetic-image-transport
  ros-noetic-nav-msgs ros-noetic-nodelet ros-noetic-pluginlib ros-noetic-rosbag ros-noetic-rosbash
  ros-noetic-roscpp ros-noetic-roslaunch ros-noetic-rosnode ros-noetic-rostest
  ros-noetic-rviz ros-noetic-sensor-msgs ros-noetic-std-msgs ros-noetic-std-srvs ros-noetic-tf2-msgs
  ros-noetic-tf2-ros ros-noetic-tf2-tools ros-noetic-visualization-msgs)

install_packages() {
  local missing=() as_root=() package status
  for package in "$@"; do
    status="$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null || true)"
    grep -qx installed <<<"$status" || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  echo "Installing with apt: ${missing[*]}"
  ((EUID == 0)) || as_root=(sudo)
  "${as_root[@]}" apt-get -o Acquire::Retries=3 update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o Acquire::Retries=3 \
    -o Dpkg::Use-Pty=0 install -qq -y --no-install-recommends "${missing[@]}"
}

if [[ -d /opt/ros/noetic ]]; then
  install_packages "${common_packages[@]}" "${noetic_packages[@]}" ca-certificates "$@"
elif grep -qx ID=ubuntu /etc/os-release; then
  echo "setup.sh: ROS Noetic is missing in /opt/ros/noetic; install it first:" \
    "https://wiki.ros.org/noetic/Installation/Ubuntu" >&2
  exit 1
else
  install_packages "${common_packages[@]}" "${debian_packages[@]}" "$@"
fi
for package in "${optional_packages[@]}"; do
  install_packages "$package" || echo "setup.sh: continuing without $package" >&2
done
