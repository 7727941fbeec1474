// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "common/geometry/rigid3.h"

namespace plm_vins {

struct ImuBias {
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // [m/s^2]
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // [rad/s]
};

// State of the body at one image, in solver layout: the arrays *are* the solver's variables.
//   pose   = [p_W (3), q_W_B (x, y, z, w)]      T_W_B; W is z up, gravity along -z
//   motion = [v_W (3), accel bias (3), gyro bias (3)]
struct FrameState {
  int64_t t_ns = 0;
  std::array<double, 7> pose = {0, 0, 0, 0, 0, 0, 1};
  std::array<double, 9> motion = {};

  Eigen::Map<Eigen::Vector3d> position() { return Eigen::Map<Eigen::Vector3d>(pose.data()); }
  Eigen::Map<const Eigen::Vector3d> position() const {
    return Eigen::Map<const Eigen::Vector3d>(pose.data());
  }
  Eigen::Map<Eigen::Quaterniond> rotation() {
    return Eigen::Map<Eigen::Quaterniond>(pose.data() + 3);
  }
  Eigen::Map<const Eigen::Quaterniond> rotation() const {
    return Eigen::Map<const Eigen::Quaterniond>(pose.data() + 3);
  }
  Eigen::Map<Eigen::Vector3d> velocity() { return Eigen::Map<Eigen::Vector3d>(motion.data()); }
  Eigen::Map<const Eigen::Vector3d> velocity() const {
    return Eigen::Map<const Eigen::Vector3d>(motion.data());
  }
  Eigen::Map<Eigen::Vector3d> accel_bias() {
    return Eigen::Map<Eigen::Vector3d>(motion.data() + 3);
  }
  Eigen::Map<const Eigen::Vector3d> accel_bias() const {
    return Eigen::Map<const Eigen::Vector3d>(motion.data() + 3);
  }
  Eigen::Map<Eigen::Vector3d> gyro_bias() { return Eigen::Map<Eigen::Vector3d>(motion.data() + 6); }
  Eigen::Map<const Eigen::Vector3d> gyro_bias() const {
    return Eigen::Map<const Eigen::Vector3d>(motion.data() + 6);
  }

  Rigid3d T_W_B() const { return {Eigen::Quaterniond(rotation()), position()}; }
  ImuBias bias() const { return {accel_bias(), gyro_bias()}; }
  void SetPose(const Rigid3d& T_W_B) {
    position() = T_W_B.translation;
    rotation() = T_W_B.rotation.normalized();
  }
  void SetBias(const ImuBias& bias) {
    accel_bias() = bias.accel;
    gyro_bias() = bias.gyro;
  }
};

}  // namespace plm_vins
