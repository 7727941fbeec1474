// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/motion_evidence.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "common/config/config.h"
#include "test/vins_estimator/simulated_problem.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/solver/window_solver.h"

namespace plm_vins {
namespace {

using testing::SimulatedWindow;

ProblemOptions Options() {
  Config config;
  config.sensor.cameras[0].parameters = simulator::DefaultSensors().cameras[0].parameters;
  config.estimator.point_noise = simulator::FeatureSimulationOptions().point_noise_px;
  config.estimator.line_noise = simulator::FeatureSimulationOptions().line_noise_px;
  return {config, testing::kSimulatedFocalLength};
}

// A prior at all current states with standard deviation `deviation` in all units.
MarginalizationPrior KnownStates(double deviation, const SlidingWindow& window) {
  std::vector<MarginalizationPrior::Block> blocks;
  int size = 0;
  const auto add = [&](const BlockId& id, const auto& values, int tangent_size) {
    MarginalizationPrior::Block block{id, size};
    std::copy(values.begin(), values.end(), block.linearization.begin());
    blocks.push_back(block);
    size += tangent_size;
  };
  for (const WindowFrame& frame : window.frames) {
    add({BlockKind::kPose, frame.state.t_ns}, frame.state.pose, 6);
    add({BlockKind::kMotion, frame.state.t_ns}, frame.state.motion, 9);
  }
  Quadratic quadratic;
  quadratic.H = Eigen::MatrixXd::Identity(size, size) / (deviation * deviation);
  quadratic.b = Eigen::VectorXd::Zero(size);
  return {blocks, quadratic};
}

// Returns the evidence on the interval that ends at the frame of this index.
std::optional<ImuNoiseEvidence> EvidenceAt(size_t end, const SlidingWindow& window,
                                           NormalEquations* equations) {
  const std::vector<WindowFrame>& frames = window.frames;
  return EvidenceOfMotion(*frames[end].motion_since_previous, window.gravity_W,
                          frames[end - 1].state, frames[end].state, equations);
}

// Evidence on the interval from frame 1 to frame 2 from motion terms and prior only, linearized at
// the current values.
ImuNoiseEvidence EvidenceWithoutImages(const MarginalizationPrior& prior, SlidingWindow* window) {
  ProblemBuilder builder(Options(), window, &prior);
  builder.AddPrior();
  for (size_t i = 1; i < window->frames.size(); ++i) builder.AddMotion(i);
  NormalEquations equations(builder.problem());
  equations.Linearize();
  return EvidenceAt(2, *window, &equations).value();
}

// The residual then has the covariance S, with contributions of three independent sources.
TEST(EvidenceOfMotion, ExpectsTheFullResidualForKnownStates) {
  SimulatedWindow simulated = testing::SimulateWindow(4);
  SlidingWindow& window = simulated.window;
  const auto evidence = EvidenceWithoutImages(KnownStates(1e-7, window), &window);
  const Preintegration& motion = *window.frames[2].motion_since_previous;
  ImuNoise walks = motion.noise();
  walks.accel_density = walks.gyro_density = 0;
  Preintegration walking = motion;
  walking.Reweigh(walks);
  const double of_walks = motion.Covariance().llt().solve(walking.Covariance()).trace();
  EXPECT_NEAR(evidence.accel.expected + evidence.gyro.expected, 15 - of_walks, 1e-2);
  EXPECT_NEAR(of_walks, 6, 0.1);
  EXPECT_NEAR(evidence.gyro.expected, 3, 0.1);
  EXPECT_EQ(evidence.accel.assumed, motion.noise().accel_density);
  EXPECT_EQ(evidence.gyro.assumed, motion.noise().gyro_density);
}

TEST(EvidenceOfMotion, ExpectsNothingFromDoubtedReadings) {
  SimulatedWindow simulated = testing::SimulateWindow(4);
  SlidingWindow& window = simulated.window;
  const auto sure = EvidenceWithoutImages(KnownStates(1e-7, window), &window);
  Preintegration& motion = *window.frames[2].motion_since_previous;
  Preintegration doubted(motion.noise(), motion.linearization_bias());
  for (ImuSample sample : motion.samples()) {
    sample.gyro_doubt = 1;
    doubted.Append(sample);
  }
  motion = doubted;
  const auto evidence = EvidenceWithoutImages(KnownStates(1e-7, window), &window);
  EXPECT_LT(evidence.gyro.expected, 1e-3 * sure.gyro.expected);
  EXPECT_LT(evidence.accel.expected, sure.accel.expected);
}

TEST(EvidenceOfMotion, ExpectsNothingIfOnlyTheImuObservesTheMotion) {
  SimulatedWindow simulated = testing::SimulateWindow(4);
  SlidingWindow& window = simulated.window;
  const auto prior = InitialPrior(InitialUncertainty(), Options(), window);
  const auto evidence = EvidenceWithoutImages(prior, &window);
  EXPECT_NEAR(evidence.accel.expected, 0, 1e-3);
  EXPECT_NEAR(evidence.gyro.expected, 0, 1e-3);
}

TEST(EvidenceOfMotion, IsNulloptForUnobservableStates) {
  SimulatedWindow simulated = testing::SimulateWindow(3);
  SlidingWindow& window = simulated.window;
  const MarginalizationPrior prior;
  ProblemBuilder builder(Options(), &window, &prior);
  builder.AddMotion(1);
  builder.AddMotion(2);
  NormalEquations equations(builder.problem());
  equations.Linearize();
  EXPECT_FALSE(EvidenceAt(1, window, &equations));
}

constexpr size_t kFrame = 4;  // index of the frame that ends the tested interval

// Changes the noise that this interval assumes.
void Assume(double share_of_accel, double share_of_gyro, SlidingWindow* window) {
  Preintegration& motion = *window->frames[kFrame].motion_since_previous;
  ImuNoise noise = motion.noise();
  noise.accel_density *= share_of_accel;
  noise.gyro_density *= share_of_gyro;
  motion.Reweigh(noise);
}

void AddEvidence(const DensityEvidence& evidence, DensityEvidence* sum) {
  sum->squared += evidence.squared;
  sum->expected += evidence.expected;
  sum->slope += evidence.slope;
}

// Windows with noise, simulated once.
class EvidenceInWindows : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (uint64_t seed = 1; seed <= 30; ++seed) {
      windows_.push_back(testing::SimulateShakenWindow(seed));
    }
  }
  static void TearDownTestSuite() { windows_.clear(); }

  // Sums over the windows, optimized after `assume` has changed their assumed noise.
  static ImuNoiseEvidence Sum(const std::function<void(SlidingWindow*)>& assume) {
    ImuNoiseEvidence sum;
    for (SimulatedWindow simulated : windows_) {
      SlidingWindow& window = simulated.window;
      for (WindowFrame& frame : window.frames) {
        auto& motion = frame.motion_since_previous;
        if (motion) motion = std::make_shared<Preintegration>(*motion);
      }
      assume(&window);
      const auto prior = InitialPrior(InitialUncertainty(), Options(), window);
      ProblemBuilder builder(Options(), &window, &prior);
      testing::AddAll(&simulated, &builder);
      NormalEquations equations(builder.problem());
      SolverOptions options;
      options.max_iterations = 20;
      SolveBy(SolverType::kSchur, options, builder.problem(), &equations);
      const auto evidence = EvidenceAt(kFrame, window, &equations).value();
      AddEvidence(evidence.accel, &sum.accel);
      AddEvidence(evidence.gyro, &sum.gyro);
    }
    return sum;
  }

  static std::vector<SimulatedWindow> windows_;
};
std::vector<SimulatedWindow> EvidenceInWindows::windows_;

// A ratio with n degrees of freedom has the standard deviation sqrt(2 / n).
double Tolerance(const DensityEvidence& sum) { return 3 * std::sqrt(2 / sum.expected); }

TEST_F(EvidenceInWindows, MatchesExpectationForCorrectNoise) {
  const ImuNoiseEvidence sum = Sum([](SlidingWindow*) {});
  EXPECT_GT(sum.accel.expected, 20);
  EXPECT_GT(sum.gyro.expected, 20);
  EXPECT_NEAR(sum.accel.squared / sum.accel.expected, 1, Tolerance(sum.accel));
  EXPECT_NEAR(sum.gyro.squared / sum.gyro.expected, 1, Tolerance(sum.gyro));
}

TEST_F(EvidenceInWindows, ShowsNoiseThatIsGreaterThanAssumed) {
  const ImuNoiseEvidence sum =
      Sum([](SlidingWindow* window) { testing::ScaleAssumedNoise(1.0 / 16, window); });
  EXPECT_GT(sum.accel.squared / sum.accel.expected, 6);
  EXPECT_GT(sum.gyro.squared / sum.gyro.expected, 6);
}

// The variance of one source in this interval is four times the assumed one, or a quarter of it.
TEST_F(EvidenceInWindows, GrowsWithTheNoiseByTheSlope) {
  for (const double share : {0.5, 2.0}) {
    const double more = 1 / (share * share) - 1;
    const auto of_accel = [share](SlidingWindow* window) { Assume(share, 1, window); };
    const DensityEvidence accel = Sum(of_accel).accel;
    EXPECT_NEAR(accel.squared / (accel.expected + more * accel.slope), 1, 0.25) << share;
    const auto of_gyro = [share](SlidingWindow* window) { Assume(1, share, window); };
    const DensityEvidence gyro = Sum(of_gyro).gyro;
    EXPECT_NEAR(gyro.squared / (gyro.expected + more * gyro.slope), 1, 0.25) << share;
  }
}

}  // namespace
}  // namespace plm_vins
