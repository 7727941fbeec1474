// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/marginalization_prior.h"
#include "vins_estimator/problem/window_problem.h"

namespace plm_vins {

// Where Jacobians by the variables of the prior are taken. At the values, the solution is the
// minimum of the cost. At the first estimates, which the prior was linearised at, equations say
// nothing of position and heading that cannot be known ([Huang2010]): for what stays in the prior.
enum class JacobiansAt { kValues, kFirstEstimates };

// What weighs the terms of the window problem, and which calibration it estimates.
struct ProblemOptions {
  // `focal_length` [px] turns pixels into normalised coordinates.
  ProblemOptions(const Config& config, double focal_length);

  // Weighs the views of points and lines by their noise, normalised.
  void SetNoise(double point_noise, double line_noise);

  // Lets a flow of this much [1/s] pass as standstill, where the depth [m] of what is seen is
  // known.
  void LetPass(double flow, std::optional<double> depth);

  double point_weight;                  // one over the noise of a corner, normalised
  double point_loss_scale = 1.0;        // Cauchy loss, in standard deviations
  double line_weight;                   // ... of a line's ends across it
  double line_loss_scale = 1.0;         // Cauchy loss, in standard deviations
  double anchor_weight;                 // the same, of what anchors have seen
  double manhattan_weight;              // one over the deviation of a line from its axis [1/rad]
  double manhattan_loss_scale = 3.0;    // Tukey loss, in standard deviations
  double standstill_velocity = 0.005;   // standard deviation while standing still [m/s]
  double standstill_position = 0.001;   // ... of the position between two frames [m]
  double standstill_rotation = 0.0005;  // ... of the rotation between two frames [rad]
  // What of steady motion passes as standstill, which is then no better known than by that.
  double passing_velocity = 0;   // [m/s]
  double passing_turn_rate = 0;  // [rad/s]
  bool estimate_extrinsic;
  bool estimate_td;
  bool estimate_readout;  // time of a rolling shutter
  bool estimate_intrinsics;
  CameraParameters camera;  // as configured
  JacobiansAt jacobians_at = JacobiansAt::kFirstEstimates;
  // Lines on its axes are held to them; none where there is no such frame.
  std::optional<Eigen::Quaterniond> R_W_M;
};

// Puts the parts of the window into a WindowProblem: one place that knows which variables and
// factors belong together, for the optimisation (all parts) and the marginalisation (the parts that
// leave the window).
class ProblemBuilder {
 public:
  // All must outlive the problem.
  ProblemBuilder(const ProblemOptions& options, SlidingWindow* window,
                 const MarginalizationPrior* prior);

  // The whole window, with the landmarks that are optimised.
  void AddAll(PointMap* points, LineMap* lines);

  // Instead of the whole window, the states of its frames after `t_ns`: by the IMU, and by what
  // they show of landmarks that are optimised and were seen twice until then. All else is constant.
  void AddStatesAfter(int64_t t_ns, PointMap* points, LineMap* lines);

  void AddPrior();
  // The IMU between frame `index` - 1 and `index`, and that they stood still where they did.
  void AddMotion(size_t index);
  // All views of a triangulated landmark.
  void AddPoint(PointLandmark* landmark);
  // The same, with what anchors have seen of it, and that it runs along its Manhattan axis, if any.
  void AddLine(LineLandmark* landmark);

  const WindowProblem& problem() const { return problem_; }

 private:
  static constexpr int kNotEliminated = -1;  // for an index: the landmark is a constant

  bool IsConstant(const BlockId& id) const;
  int AddVariable(const BlockId& id);
  double* Values(const BlockId& id);
  // Views in the frames that are solved for; the landmark is a constant.
  void AddViewsOfKnown(PointLandmark* landmark);
  void AddViewsOfKnown(LineLandmark* landmark);
  // Of the landmark `index`.
  template <typename FactorType, int kCount>
  void AddTerm(int index, const FactorType& factor, const ceres::LossFunction* loss,
               const int (&variables)[kCount]);
  template <typename ViewFactor, typename... Indices>
  void AddPointTerm(int index, const PointLandmark& landmark, const PointView& view,
                    Indices... variables);
  // The same, with the factor as it is but for the intrinsics.
  template <typename ViewFactor, typename... Indices>
  void AddPointFactor(int index, const ViewFactor& factor, const PointLandmark& landmark,
                      const PointView& view, Indices... variables);
  template <typename ViewFactor, typename... Indices>
  void AddLineTerm(int index, const LineLandmark& landmark, const LineView& view, double weight,
                   Indices... variables);
  int Pose(int64_t t_ns) { return AddVariable({BlockKind::kPose, t_ns}); }
  int Motion(int64_t t_ns) { return AddVariable({BlockKind::kMotion, t_ns}); }

  const ProblemOptions options_;
  SlidingWindow* window_;
  const MarginalizationPrior* prior_;
  std::optional<int64_t> constants_until_ns_;  // all but the states of frames after it
  std::unique_ptr<const CameraModel> camera_;  // as it is known; null: it is not estimated
  ceres::CauchyLoss point_loss_;
  ceres::CauchyLoss line_loss_;
  ceres::TukeyLoss manhattan_loss_;
  WindowProblem problem_;
};

}  // namespace plm_vins
