// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/motion_initializer.h"

#include "common/format.h"
#include "common/geometry/so3.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/initialization/visual_inertial_alignment.h"
#include "vins_estimator/initialization/visual_inertial_bundle.h"
#include "vins_estimator/structure_from_motion/global_sfm.h"
#include "vins_estimator/structure_from_motion/relative_pose.h"
#include "vins_estimator/structure_from_motion/stereo_structure.h"
#include "vins_estimator/structure_from_motion/tracks.h"

namespace plm_vins {
namespace {

constexpr double kStereoScaleDeviation = 0.01;
constexpr double kMaxOutlierShare = 0.2;    // share of observations, with stereo or depth
constexpr double kMinStereoAngle_px = 1.0;  // between the rays of a point in two cameras

// One attempt at initialization, step by step.
class Attempt {
 public:
  Attempt(const std::vector<FrameMeasurement>& frames, const SensorConfig& sensor,
          double point_noise_px, const MotionInitializerOptions& options, std::string* reason);

  std::optional<std::vector<FrameState>> Run();

 private:
  bool EstimateBias();
  bool SetGyroBias(const std::vector<RotationMeasurement>& rotations);
  std::optional<RotationMeasurement> MeasureRotation(int interval) const;
  void ChainRotations();
  bool Reconstruct();
  bool ReconstructInStereo();
  void AdoptStereo(const StereoStructure& stereo);
  std::vector<Rigid3d> Extrinsics() const;
  bool Align();
  void SetStates();
  bool Adjust();
  bool CheckBiases();
  bool CheckAdjustment(const VisualInertialBundle& bundle);
  void MoveWorldToFirstFrame();

  const std::vector<FrameMeasurement>& frames_;
  const SensorConfig& sensor_;
  Rigid3d T_B_C_;  // of the camera that starts
  double focal_length_;
  double noise_px_;
  MotionInitializerOptions options_;
  std::string* reason_;

  std::vector<Track> tracks_;
  std::vector<Preintegration> preintegrations_;      // interval i is from frame i to i + 1
  std::vector<Eigen::Quaterniond> R_G_B_;            // G: body frame of the first image
  Structure structure_;                              // in G
  Alignment alignment_;                              // in G
  std::vector<std::optional<Eigen::Vector3d>> p_W_;  // per track
  std::vector<FrameState> states_;
};

Attempt::Attempt(const std::vector<FrameMeasurement>& frames, const SensorConfig& sensor,
                 double point_noise_px, const MotionInitializerOptions& options,
                 std::string* reason)
    : frames_(frames),
      sensor_(sensor),
      T_B_C_(sensor.cameras[options.camera].T_B_C),
      focal_length_(CameraModel::Create(sensor.cameras[options.camera].parameters)->FocalLength()),
      noise_px_(point_noise_px),
      options_(options),
      reason_(reason) {
  std::vector<const PointFrame*> views;
  views.reserve(frames.size());
  for (const FrameMeasurement& frame : frames) views.push_back(&frame.points);
  tracks_ = CollectTracks(views);
  if (!options.stereo) tracks_ = OfCamera(options.camera, tracks_);
  for (size_t i = 0; i + 1 < frames.size(); ++i) {
    preintegrations_.emplace_back(sensor.imu_noise, ImuBias{});
    for (const ImuSample& sample : frames[i + 1].imu) preintegrations_.back().Append(sample);
  }
}

// Returns the rotation of the body over the interval, measured by the camera.
std::optional<RotationMeasurement> Attempt::MeasureRotation(int interval) const {
  const Preintegration& imu = preintegrations_[interval];
  const Eigen::Quaterniond R_B_C = T_B_C_.rotation;
  const Eigen::Quaterniond R_now_then = R_B_C.conjugate() * imu.delta_q().conjugate() * R_B_C;
  const auto pose = EstimateRelativePose(FindCorrespondences(tracks_, interval, interval + 1),
                                         R_now_then, noise_px_ / focal_length_, reason_);
  if (!pose) return std::nullopt;
  const Eigen::Matrix3d R = R_B_C.toRotationMatrix();
  return RotationMeasurement{&imu, R_B_C * pose->R_now_then.conjugate() * R_B_C.conjugate(),
                             R * pose->rotation_information * R.transpose()};
}

bool Attempt::EstimateBias() {
  std::vector<RotationMeasurement> rotations;
  size_t failed = 0;
  for (size_t i = 0; i < preintegrations_.size(); ++i) {
    if (const auto rotation = MeasureRotation(static_cast<int>(i))) {
      rotations.push_back(*rotation);
    } else if (2 * ++failed > preintegrations_.size()) {
      return false;  // with the last pair's reason; RANSAC without solution takes longest
    }
  }
  return SetGyroBias(rotations);
}

bool Attempt::SetGyroBias(const std::vector<RotationMeasurement>& rotations) {
  const auto gyro_bias = EstimateGyroBias(rotations, reason_);
  if (!gyro_bias) return false;
  for (Preintegration& imu : preintegrations_) {
    imu.Repropagate({Eigen::Vector3d::Zero(), *gyro_bias});
  }
  return true;
}

void Attempt::ChainRotations() {
  R_G_B_.assign(1, Eigen::Quaterniond::Identity());
  for (const Preintegration& imu : preintegrations_) {
    R_G_B_.push_back((R_G_B_.back() * imu.delta_q()).normalized());
  }
}

bool Attempt::Reconstruct() {
  std::vector<Eigen::Quaterniond> R_G_C;
  for (const Eigen::Quaterniond& R_G_B : R_G_B_) R_G_C.push_back(R_G_B * T_B_C_.rotation);
  const GlobalSfmOptions options{focal_length_, noise_px_,
                                 options_.min_parallax_sigmas * noise_px_};
  const auto structure = ReconstructStructure(tracks_, R_G_C, options, reason_);
  if (structure) structure_ = *structure;
  return structure.has_value();
}

std::vector<Rigid3d> Attempt::Extrinsics() const {
  std::vector<Rigid3d> T_B_C;
  for (const CameraSensor& camera : sensor_.cameras) T_B_C.push_back(camera.T_B_C);
  return T_B_C;
}

// Replaces EstimateBias() and Reconstruct() if points have a depth in single frames.
bool Attempt::ReconstructInStereo() {
  ChainRotations();  // from the biased gyroscope, as initial values
  const StereoStructureOptions options{Extrinsics(), noise_px_ / focal_length_,
                                       kMinStereoAngle_px / focal_length_};
  const auto stereo = ReconstructFromStereo(tracks_, R_G_B_, options, reason_);
  if (!stereo) return false;
  if (!SetGyroBias(RotationsBetween(*stereo, preintegrations_))) return false;
  ChainRotations();
  AdoptStereo(*stereo);
  return true;
}

// Takes over positions and points from the frame S of one of the views.
void Attempt::AdoptStereo(const StereoStructure& stereo) {
  const Eigen::Quaterniond R_G_S = stereo.T_G_B.front().rotation.conjugate();
  const Eigen::Vector3d origin_S = (stereo.T_G_B.front() * T_B_C_).translation;
  const auto in_G = [&](const Eigen::Vector3d& p_S) -> Eigen::Vector3d {
    return R_G_S * (p_S - origin_S);
  };
  for (const Rigid3d& T_S_B : stereo.T_G_B) {
    structure_.p_G_C.push_back(in_G((T_S_B * T_B_C_).translation));
  }
  structure_.p_G.resize(tracks_.size());
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (stereo.p_G[i]) structure_.p_G[i] = in_G(*stereo.p_G[i]);
  }
}

bool Attempt::Align() {
  std::vector<AlignmentView> views;
  for (size_t i = 0; i < R_G_B_.size(); ++i) views.push_back({R_G_B_[i], structure_.p_G_C[i]});
  std::vector<const Preintegration*> preintegrations;
  for (const Preintegration& imu : preintegrations_) preintegrations.push_back(&imu);
  AlignmentOptions options{T_B_C_, sensor_.gravity_norm, sensor_.accel_bias_deviation};
  if (options_.stereo) options.scale_deviation = kStereoScaleDeviation;
  const auto alignment = AlignVisualInertial(views, preintegrations, options, reason_);
  if (alignment) alignment_ = *alignment;
  return alignment.has_value();
}

// Transforms the aligned states and points into a world with gravity along -z.
void Attempt::SetStates() {
  const Eigen::Quaterniond R_W_G =
      ShortestRotation(-alignment_.gravity_G, Eigen::Vector3d::UnitZ());
  const ImuBias bias{alignment_.accel_bias, preintegrations_.front().linearization_bias().gyro};
  states_.resize(frames_.size());
  for (size_t i = 0; i < frames_.size(); ++i) {
    const Eigen::Quaterniond R_G_C = R_G_B_[i] * T_B_C_.rotation;
    const Rigid3d T_W_C(R_W_G * R_G_C, R_W_G * (alignment_.scale * structure_.p_G_C[i]));
    states_[i].t_ns = frames_[i].t_ns;
    states_[i].SetPose(T_W_C * T_B_C_.Inverse());
    states_[i].velocity() = R_W_G * alignment_.velocity_G[i];
    states_[i].SetBias(bias);
  }
  p_W_.resize(tracks_.size());
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (structure_.p_G[i]) p_W_[i] = R_W_G * (alignment_.scale * *structure_.p_G[i]);
  }
}

bool Attempt::CheckBiases() {
  const double accel = states_.back().accel_bias().norm();
  const double gyro = states_.back().gyro_bias().norm();
  if (accel > options_.max_accel_bias) {
    *reason_ = Format("implausible accelerometer bias: %.2f m/s^2 of at most %.2f", accel,
                      options_.max_accel_bias);
    return false;
  }
  if (gyro > options_.max_gyro_bias) {
    *reason_ =
        Format("implausible gyro bias: %.3f rad/s of at most %.3f", gyro, options_.max_gyro_bias);
    return false;
  }
  return true;
}

bool Attempt::CheckAdjustment(const VisualInertialBundle& bundle) {
  if (bundle.reprojection_rms > options_.max_reprojection_rms) {
    *reason_ = Format("point residuals are too large: %.1f sigma of at most %.1f",
                      bundle.reprojection_rms, options_.max_reprojection_rms);
    return false;
  }
  if (bundle.imu_rms > options_.max_imu_rms) {
    *reason_ = Format("camera and IMU disagree: %.1f sigma of at most %.1f", bundle.imu_rms,
                      options_.max_imu_rms);
    return false;
  }
  if (options_.stereo && bundle.outlier_share > kMaxOutlierShare) {
    *reason_ = Format("depths contradict the points: %.0f %% outliers of at most %.0f %%",
                      100 * bundle.outlier_share, 100 * kMaxOutlierShare);
    return false;
  }
  if (!options_.stereo && bundle.relative_scale_deviation > options_.max_scale_deviation) {
    *reason_ = Format("scale not observable yet: uncertain by %.1f %% of at most %.1f %%",
                      100 * bundle.relative_scale_deviation, 100 * options_.max_scale_deviation);
    return false;
  }
  return true;
}

bool Attempt::Adjust() {
  VisualInertialBundleOptions options{Extrinsics(), sensor_.gravity_norm, noise_px_ / focal_length_,
                                      sensor_.accel_bias_deviation};
  if (sensor_.depth) options.depth_noise = sensor_.depth->noise;
  if (!options_.stereo) options.max_scale_deviation = options_.max_scale_deviation;
  const auto bundle =
      AdjustVisualInertialBundle(tracks_, p_W_, preintegrations_, options, &states_, reason_);
  return bundle && CheckAdjustment(*bundle) && CheckBiases();
}

void Attempt::MoveWorldToFirstFrame() {
  const Eigen::Quaterniond heading(Eigen::AngleAxisd(
      -Yaw(Eigen::Quaterniond(states_.front().rotation())), Eigen::Vector3d::UnitZ()));
  const Rigid3d T_new_old(heading, -(heading * states_.front().position()));
  for (FrameState& state : states_) {
    state.SetPose(T_new_old * state.T_W_B());
    state.velocity() = heading * state.velocity().eval();
  }
}

std::optional<std::vector<FrameState>> Attempt::Run() {
  if (options_.stereo) {
    if (!ReconstructInStereo()) return std::nullopt;
  } else {
    if (!EstimateBias()) return std::nullopt;
    ChainRotations();
    if (!Reconstruct()) return std::nullopt;
  }
  if (!Align()) return std::nullopt;
  SetStates();
  if (!Adjust()) return std::nullopt;
  MoveWorldToFirstFrame();
  return states_;
}

}  // namespace

std::optional<std::vector<FrameState>> InitializeFromMotion(
    const std::vector<FrameMeasurement>& frames, const SensorConfig& sensor, double point_noise_px,
    const MotionInitializerOptions& options, std::string* reason) {
  return Attempt(frames, sensor, point_noise_px, options, reason).Run();
}

}  // namespace plm_vins
