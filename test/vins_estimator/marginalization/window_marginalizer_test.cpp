// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/marginalization/window_marginalizer.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <memory>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_problem.h"
#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/marginalization/window_estimate.h"
#include "vins_estimator/problem/initial_prior.h"

namespace plm_vins {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::SimulatedWindow;

std::unique_ptr<const ProblemBuilder> BuildProblem(const ProblemOptions& options,
                                                   WindowEstimate* estimate) {
  auto builder = std::make_unique<ProblemBuilder>(options, &estimate->map.window, &estimate->prior);
  testing::AddAll(&estimate->map, builder.get());
  return builder;
}

struct Step {
  std::vector<BlockId> ids;
  std::vector<VectorXd> deltas;  // for each id

  const VectorXd* Find(const BlockId& id) const {
    const auto found = std::find(ids.begin(), ids.end(), id);
    return found == ids.end() ? nullptr : &deltas[found - ids.begin()];
  }
};

// The Gauss-Newton step of the frame variables at the current values.
Step GaussNewtonStep(const WindowProblem& problem) {
  NormalEquations equations(problem);
  equations.Linearize();
  MatrixXd S;
  VectorXd g;
  equations.Reduce(0, &S, &g);
  S = MatrixXd(S.selfadjointView<Eigen::Upper>());
  const VectorXd scale = S.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled_S = scale.asDiagonal() * S * scale.asDiagonal();
  const VectorXd step = -(scale.asDiagonal() * scaled_S.ldlt().solve(scale.cwiseProduct(g)));
  Step result;
  for (size_t i = 0; i < problem.variables().size(); ++i) {
    const int offset = equations.DenseOffset(static_cast<int>(i));
    if (offset < 0) continue;
    result.ids.push_back(problem.variables()[i].id);
    result.deltas.push_back(step.segment(offset, problem.variables()[i].type().tangent_size));
  }
  return result;
}

void ExpectSameStep(const Step& kept, const Step& full) {
  for (size_t i = 0; i < kept.ids.size(); ++i) {
    const VectorXd* expected = full.Find(kept.ids[i]);
    ASSERT_NE(expected, nullptr);
    EXPECT_MATRIX_NEAR(kept.deltas[i], *expected, 1e-7 + 1e-5 * expected->norm());
  }
}

// Equal up to rounding, relative to the information of each variable.
void ExpectSamePrior(const MarginalizationPrior& a, const MarginalizationPrior& b) {
  ASSERT_EQ(a.blocks().size(), b.blocks().size());
  for (size_t i = 0; i < a.blocks().size(); ++i) {
    EXPECT_EQ(a.blocks()[i].id, b.blocks()[i].id);
    EXPECT_EQ(a.blocks()[i].linearization, b.blocks()[i].linearization);
  }
  const VectorXd scale = b.quadratic().H.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_MATRIX_NEAR(MatrixXd(scale.asDiagonal() * a.quadratic().H * scale.asDiagonal()),
                     MatrixXd(scale.asDiagonal() * b.quadratic().H * scale.asDiagonal()), 1e-7);
  const VectorXd scaled_b = scale.cwiseProduct(b.quadratic().b);
  EXPECT_MATRIX_NEAR(VectorXd(scale.cwiseProduct(a.quadratic().b)), scaled_b,
                     1e-7 * scaled_b.norm());
}

// A Gauss-Newton step of the reduced window equals that of the whole, at the same linearization
// point.
class MarginalizeOldestTest : public ::testing::TestWithParam<JacobiansAt> {
 protected:
  MarginalizeOldestTest() : estimate_(testing::SimulateWindow(6)), random_(1) {
    options_.jacobians_at = GetParam();
    options_.estimate_extrinsic = options_.estimate_td = options_.estimate_intrinsics = true;
    testing::Disturb(0.003, &random_, &estimate_.map.window);
    estimate_.prior = InitialPrior(InitialUncertainty(), options_, estimate_.map.window);
    testing::Disturb(0.001, &random_, &estimate_.map.window);
  }

  WindowEstimate estimate_;
  simulator::Random random_;
  ProblemOptions options_ = testing::OnePixelOptions();
};

TEST_P(MarginalizeOldestTest, KeepsTheGaussNewtonStep) {
  for (const bool keep_pose : {false, true, false}) {
    const Step full = GaussNewtonStep(BuildProblem(options_, &estimate_)->problem());
    estimate_.SlideOldest(options_, keep_pose);
    const Step kept = GaussNewtonStep(BuildProblem(options_, &estimate_)->problem());
    EXPECT_EQ(kept.ids.size() + (keep_pose ? 1 : 2), full.ids.size());
    ExpectSameStep(kept, full);
    testing::Disturb(0.0005, &random_, &estimate_.map.window);  // as an optimization would
  }
}

TEST_P(MarginalizeOldestTest, KeepsThePoseOfAnAnchorWithoutItsMotion) {
  const int64_t oldest_ns = estimate_.map.window.frames.front().state.t_ns;
  estimate_.SlideOldest(options_, /*stays_as_anchor=*/true);
  EXPECT_EQ(estimate_.prior.Linearization({BlockKind::kMotion, oldest_ns}), nullptr);
  EXPECT_NE(estimate_.prior.Linearization({BlockKind::kPose, oldest_ns}), nullptr);
  const auto builder = BuildProblem(options_, &estimate_);
  const int pose = builder->problem().Find({BlockKind::kPose, oldest_ns});
  ASSERT_GE(pose, 0);
  EXPECT_EQ(builder->problem().variables()[pose].values,
            estimate_.map.window.anchors[0].state.pose.data());
}

TEST_P(MarginalizeOldestTest, RemovedAnchorLeavesNoTrace) {
  estimate_.SlideOldest(options_, /*stays_as_anchor=*/false);
  const int64_t oldest_ns = estimate_.map.window.frames.front().state.t_ns;
  const auto marginalize = [this](bool keep_pose) {
    return MarginalizeOldest(options_, estimate_.prior, &estimate_.map, keep_pose);
  };
  const MarginalizationPrior never_kept = marginalize(false);
  const MarginalizationPrior kept = marginalize(true);
  EXPECT_EQ(kept.quadratic().b.size(), never_kept.quadratic().b.size() + 6);
  ExpectSamePrior(kept.Marginalize(IsOfFrame(oldest_ns)), never_kept);
}

TEST_P(MarginalizeOldestTest, KeepsLinearizationPointsOnlyForFirstEstimates) {
  estimate_.SlideOldest(options_, /*stays_as_anchor=*/false);
  const FrameState& state = estimate_.map.window.frames[1].state;
  const BlockId id{BlockKind::kPose, state.t_ns};
  ASSERT_NE(estimate_.prior.Linearization(id), nullptr);
  const double before = estimate_.prior.Linearization(id)[0];
  testing::Disturb(0.001, &random_, &estimate_.map.window);
  estimate_.SlideOldest(options_, /*stays_as_anchor=*/false);
  ASSERT_NE(estimate_.prior.Linearization(id), nullptr);
  EXPECT_EQ(estimate_.prior.Linearization(id)[0],
            GetParam() == JacobiansAt::kFirstEstimates
                ? before
                : estimate_.map.window.frames[0].state.position().x());
}

INSTANTIATE_TEST_SUITE_P(JacobiansAt, MarginalizeOldestTest,
                         ::testing::Values(JacobiansAt::kFirstEstimates, JacobiansAt::kValues));

// Tangent vectors of a common motion of all states: translation and rotation about an axis of W.
VectorXd Motion(const MarginalizationPrior& prior, const Vector3d& translation,
                const Vector3d& axis) {
  VectorXd direction = VectorXd::Zero(prior.quadratic().b.size());
  for (const MarginalizationPrior::Block& block : prior.blocks()) {
    const double* x = block.linearization.data();
    if (block.id.kind == BlockKind::kPose) {
      const Eigen::Quaterniond q_W_B(Eigen::Map<const Eigen::Quaterniond>(x + 3));
      direction.segment<3>(block.offset) = translation + axis.cross(Vector3d(x));
      direction.segment<3>(block.offset + 3) = q_W_B.conjugate() * axis;
    } else if (block.id.kind == BlockKind::kMotion) {
      direction.segment<3>(block.offset) = axis.cross(Vector3d(x));
    }
  }
  return direction;
}

// Information along a unit direction (position in meters, rotation in radians).
double Information(const MarginalizationPrior& prior, const Vector3d& translation,
                   const Vector3d& axis) {
  const VectorXd direction = Motion(prior, translation, axis);
  return direction.dot(prior.quadratic().H * direction);
}

struct GaugeInformation {
  double position, heading, inclination;
};

// Information of the prior about the four unobservable directions and the observable inclination
// after several marginalizations without anchor; the states differ from the truth and change in
// between.
GaugeInformation SlideWithoutAnchor(JacobiansAt jacobians_at, int rounds) {
  WindowEstimate estimate(testing::SimulateWindow(8));
  ProblemOptions options = testing::OnePixelOptions();
  options.jacobians_at = jacobians_at;
  simulator::Random random(1);
  for (int round = 0; round < rounds; ++round) {
    testing::Disturb(0.01, &random, &estimate.map.window);
    estimate.SlideOldest(options, /*stays_as_anchor=*/false);
  }
  const auto along = [&estimate](const Vector3d& translation, const Vector3d& axis) {
    return std::abs(Information(estimate.prior, translation, axis));
  };
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const Vector3d none = Vector3d::Zero();
  return {std::max({along(x, none), along(y, none), along(z, none)}), along(none, z),
          std::min(along(none, x), along(none, y))};
}

TEST(UnobservableDirections, StayWithoutInformation) {
  for (const int rounds : {1, 2, 5}) {
    const GaugeInformation information = SlideWithoutAnchor(JacobiansAt::kFirstEstimates, rounds);
    EXPECT_LT(information.position, 1e-4) << rounds;    // known to 100 m at best
    EXPECT_LT(information.heading, 1e-4) << rounds;     // standard deviation of 100 rad
    EXPECT_GT(information.inclination, 100) << rounds;  // standard deviation below 0.1 rad
  }
}

TEST(UnobservableDirections, WouldGainInformationWithoutFirstEstimates) {
  const GaugeInformation information = SlideWithoutAnchor(JacobiansAt::kValues, 5);
  // A false standard deviation of 0.1 rad.
  EXPECT_GT(information.heading, 100);
}

}  // namespace
}  // namespace plm_vins
