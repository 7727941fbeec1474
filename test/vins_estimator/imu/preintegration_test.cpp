// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/preintegration.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/geometry/so3.h"
#include "simulator/imu_simulator.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Index = ImuErrorIndex;

const Vector3d kGravity_W(0, 0, -9.81);

std::vector<ImuSample> ConstantMotion(const Vector3d& gyro, const Vector3d& accel, double duration,
                                      double rate_hz) {
  std::vector<ImuSample> samples;
  const int intervals = static_cast<int>(std::lround(duration * rate_hz));
  for (int i = 0; i <= intervals; ++i) {
    samples.push_back({ToNanoseconds(i / rate_hz), gyro, accel});
  }
  return samples;
}

Preintegration Integrate(const std::vector<ImuSample>& samples, const ImuBias& bias = ImuBias(),
                         const ImuNoise& noise = ImuNoise()) {
  Preintegration result(noise, bias);
  for (const ImuSample& sample : samples) result.Append(sample);
  return result;
}

simulator::Trajectory FastFlight() {
  simulator::TrajectoryOptions options;
  options.motion = simulator::Motion::kFast;
  options.duration = 6.0;
  return simulator::Trajectory(options);
}

// Noise-free samples of the fast flight from `start` to `end` [s].
std::vector<ImuSample> Flight(double start, double end, double rate_hz = 200.0) {
  simulator::ImuSimulationOptions options;
  options.add_noise = false;
  options.rate_hz = rate_hz;
  std::vector<ImuSample> samples;
  for (const ImuSample& sample : simulator::SimulateImu(FastFlight(), options).samples) {
    const double t = ToSeconds(sample.t_ns);
    if (t > start - 1e-6 && t < end + 1e-6) samples.push_back(sample);
  }
  return samples;
}

// Single and double integrals over [0, T] of a constant force f in a body that rotates at a
// constant rate w, from Exp(w t) = I + sin/|w| K + (1 - cos)/|w|^2 K^2.
struct ClosedForm {
  Vector3d velocity, position;
};
ClosedForm ConstantRateAndForce(const Vector3d& w, const Vector3d& f, double T) {
  const double r = w.norm();
  const Matrix3d K = Skew(w);
  const double c = std::cos(r * T), s = std::sin(r * T);
  const Matrix3d once =
      T * Matrix3d::Identity() + (1 - c) / (r * r) * K + (T - s / r) / (r * r) * K * K;
  const Matrix3d twice = 0.5 * T * T * Matrix3d::Identity() + (T - s / r) / (r * r) * K +
                         (0.5 * T * T + (c - 1) / (r * r)) / (r * r) * K * K;
  return {once * f, twice * f};
}

TEST(Preintegration, ConvergesQuadraticallyToConstantRateAndForce) {
  const Vector3d w(0.6, -1.1, 0.8), f(1.0, 2.0, 9.0);
  const ClosedForm truth = ConstantRateAndForce(w, f, 1.5);
  double previous_error = 0;
  for (const double rate_hz : {100.0, 200.0, 400.0}) {
    const Preintegration result = Integrate(ConstantMotion(w, f, 1.5, rate_hz));
    EXPECT_LT(result.delta_q().angularDistance(SO3Exp(1.5 * w)), 1e-7);
    const double error =
        (result.delta_v() - truth.velocity).norm() + (result.delta_p() - truth.position).norm();
    EXPECT_LT(error, 2e-3 * std::pow(100.0 / rate_hz, 2));
    if (previous_error > 0) {
      EXPECT_NEAR(previous_error / error, 4.0, 0.1);
    }
    previous_error = error;
  }
}

TEST(Preintegration, PredictsTheStateOnASmoothFlight) {
  const simulator::Trajectory trajectory = FastFlight();
  for (const double t : {2.0, 3.1, 4.7}) {
    const simulator::BodyState begin = trajectory.At(t), end = trajectory.At(t + 0.5);
    FrameState start;
    start.SetPose(begin.T_W_B);
    start.velocity() = begin.v_W;
    const FrameState predicted = Integrate(Flight(t, t + 0.5)).Predict(start, kGravity_W);
    EXPECT_EQ(predicted.t_ns, 500'000'000);
    EXPECT_MATRIX_NEAR(predicted.position(), end.T_W_B.translation, 1e-4);
    EXPECT_MATRIX_NEAR(predicted.velocity(), end.v_W, 4e-4);
    EXPECT_LT(predicted.rotation().angularDistance(end.T_W_B.rotation), 1e-4);
  }
}

TEST(Preintegration, RemovesTheLinearizationBias) {
  const ImuBias bias{{0.2, -0.1, 0.3}, {0.02, 0.03, -0.01}};
  const std::vector<ImuSample> clean = Flight(3.0, 3.5);
  std::vector<ImuSample> biased = clean;
  for (ImuSample& sample : biased) {
    sample.accel += bias.accel;
    sample.gyro += bias.gyro;
  }
  const Preintegration expected = Integrate(clean), actual = Integrate(biased, bias);
  EXPECT_MATRIX_NEAR(actual.delta_p(), expected.delta_p(), 1e-12);
  EXPECT_MATRIX_NEAR(actual.delta_v(), expected.delta_v(), 1e-12);
  EXPECT_MATRIX_NEAR(actual.delta_q().coeffs(), expected.delta_q().coeffs(), 1e-12);
}

TEST(Preintegration, BiasJacobiansAreTheDerivativesOfRepropagation) {
  const ImuBias bias{{0.05, 0.1, -0.1}, {0.01, -0.02, 0.03}};
  const Preintegration nominal = Integrate(Flight(3.0, 4.0), bias);
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  const auto deltas = [&](const Vector6d& change) -> Eigen::VectorXd {
    Preintegration moved = nominal;
    moved.Repropagate({bias.accel + change.head<3>(), bias.gyro + change.tail<3>()});
    Eigen::VectorXd result(9);
    result << moved.delta_p(), SO3Log(nominal.delta_q().conjugate() * moved.delta_q()),
        moved.delta_v();
    return result;
  };
  const Vector6d zero = Vector6d::Zero();
  EXPECT_MATRIX_NEAR((nominal.jacobian().block<9, 6>(0, Index::kAccelBias)),
                     testing::NumericJacobian(deltas, zero), 1e-7);
}

TEST(Preintegration, BiasCorrectionHasSecondOrderError) {
  const Preintegration nominal = Integrate(Flight(3.0, 3.5));
  double previous_error = 0;
  for (const double scale : {1.0, 0.5}) {
    const ImuBias bias{scale * Vector3d(0.1, -0.2, 0.1), scale * Vector3d(0.05, 0.04, -0.06)};
    Preintegration exact = nominal;
    exact.Repropagate(bias);
    const double error = (nominal.DeltaP(bias) - exact.delta_p()).norm() +
                         (nominal.DeltaV(bias) - exact.delta_v()).norm() +
                         nominal.DeltaQ(bias).angularDistance(exact.delta_q());
    EXPECT_LT(error, 5e-3 * scale * scale);
    if (previous_error > 0) {
      EXPECT_NEAR(previous_error / error, 4.0, 0.2);
    }
    previous_error = error;
  }
}

TEST(Preintegration, RepropagationEqualsNewIntegration) {
  const ImuBias bias{{0.1, 0, 0}, {0, 0.1, 0}};
  Preintegration repropagated = Integrate(Flight(3.0, 3.2));
  repropagated.SqrtInformation();  // the cached value must be invalidated
  repropagated.Repropagate(bias);
  const Preintegration anew = Integrate(Flight(3.0, 3.2), bias);
  EXPECT_MATRIX_NEAR(repropagated.delta_p(), anew.delta_p(), 0.0);
  EXPECT_MATRIX_NEAR(repropagated.jacobian(), anew.jacobian(), 0.0);
  EXPECT_MATRIX_NEAR(repropagated.Covariance(), anew.Covariance(), 0.0);
  EXPECT_MATRIX_NEAR(repropagated.SqrtInformation(), anew.SqrtInformation(), 0.0);
}

TEST(Preintegration, SqrtInformationIsTheUpperFactorOfTheInverse) {
  for (const double duration : {0.005, 0.05, 1.0}) {  // a single interval must suffice
    const Preintegration result = Integrate(Flight(3.0, 3.0 + duration));
    const Matrix15d& U = result.SqrtInformation();
    EXPECT_TRUE(U.isUpperTriangular(0.0));
    EXPECT_MATRIX_NEAR(U * result.Covariance() * U.transpose(), Matrix15d::Identity(), 1e-8);
  }
}

TEST(Preintegration, RejectsStampsThatDoNotIncreaseAndEmptyIntervals) {
  Preintegration result{ImuNoise(), ImuBias()};
  result.Append({100, Vector3d::Zero(), Vector3d::Zero()});
  EXPECT_THROW(result.Append({100, Vector3d::Zero(), Vector3d::Zero()}), std::invalid_argument);
  EXPECT_THROW(result.Append({99, Vector3d::Zero(), Vector3d::Zero()}), std::invalid_argument);
  EXPECT_EQ(result.samples().size(), 1u);
  EXPECT_THROW(result.SqrtInformation(), std::logic_error);
}

// Draws errors of the preintegration, true minus estimated, to which its covariance refers.
class MonteCarlo {
 public:
  explicit MonteCarlo(const ImuNoise& noise)
      : noise_(noise), clean_(Flight(3.0, 3.5)), truth_(Integrate(clean_)), random_(7) {}

  Matrix15d Covariance() { return Integrate(clean_, ImuBias(), noise_).Covariance(); }

  Vector15d DrawError() {
    const double dt = 0.005;
    std::vector<ImuSample> noisy = clean_;
    ImuBias bias;
    for (ImuSample& sample : noisy) {
      sample.gyro += bias.gyro + noise_.gyro_density / std::sqrt(dt) * random_.NormalVector3();
      sample.accel += bias.accel + noise_.accel_density / std::sqrt(dt) * random_.NormalVector3();
      if (&sample == &noisy.back()) break;
      bias.gyro += noise_.gyro_walk * std::sqrt(dt) * random_.NormalVector3();
      bias.accel += noise_.accel_walk * std::sqrt(dt) * random_.NormalVector3();
    }
    const Preintegration estimate = Integrate(noisy);
    Vector15d error;
    error << truth_.delta_p() - estimate.delta_p(),
        SO3Log(estimate.delta_q().conjugate() * truth_.delta_q()),
        truth_.delta_v() - estimate.delta_v(), bias.accel, bias.gyro;
    return error;
  }

 private:
  ImuNoise noise_;
  std::vector<ImuSample> clean_;
  Preintegration truth_;
  simulator::Random random_;
};

// For `runs` draws of a Gaussian, the mean of a squared Mahalanobis distance over its degrees of
// freedom is 1 within sqrt(2 / (runs * degrees)). Bounds are five times that, plus 2 % for what the
// covariance neglects: end effects of the white noise (half a sample in a hundred).
double ChiSquareBound(int runs, int degrees) {
  return 0.02 + 5.0 * std::sqrt(2.0 / (static_cast<double>(runs) * degrees));
}

TEST(Preintegration, CovarianceMatchesMonteCarlo) {
  // Bias random walks as strong as the white noise, so that each part of the covariance matters.
  ImuNoise noise;
  noise.gyro_density = 1e-3;
  noise.accel_density = 1e-2;
  noise.gyro_walk = 4e-3;
  noise.accel_walk = 4e-2;
  constexpr int kRuns = 3000;
  MonteCarlo simulation(noise);
  const Matrix15d covariance = simulation.Covariance();
  const Eigen::LLT<Matrix15d> llt(covariance);
  Matrix15d whitened_covariance = Matrix15d::Zero();
  Eigen::Matrix<double, 5, 1> block_nees = Eigen::Matrix<double, 5, 1>::Zero();
  for (int run = 0; run < kRuns; ++run) {
    const Vector15d error = simulation.DrawError();
    const Vector15d whitened = llt.matrixL().solve(error);
    whitened_covariance += whitened * whitened.transpose() / kRuns;
    for (int block = 0; block < 5; ++block) {
      const Vector3d part = error.segment<3>(3 * block);
      const Matrix3d part_covariance = covariance.block<3, 3>(3 * block, 3 * block);
      block_nees[block] += part.dot(part_covariance.inverse() * part) / (3.0 * kRuns);
    }
  }
  EXPECT_NEAR(whitened_covariance.trace() / 15.0, 1.0, ChiSquareBound(kRuns, 15));
  for (int block = 0; block < 5; ++block) {
    EXPECT_NEAR(block_nees[block], 1.0, ChiSquareBound(kRuns, 3)) << "block " << block;
  }
  EXPECT_MATRIX_NEAR(whitened_covariance, Matrix15d::Identity(), ChiSquareBound(kRuns, 1));
}

TEST(Preintegration, AGapAddsTheUncertaintyOfARandomWalkBetweenItsEnds) {
  const ImuSample begin{0, Vector3d::Zero(), Vector3d::Zero()};
  ImuSample end = begin;
  end.t_ns = 200'000'000;
  const Preintegration over_gap = Integrate({begin, end});
  EXPECT_TRUE(over_gap.HasGap());
  const Matrix15d gap = over_gap.Covariance();
  const double bridge = std::pow(0.2, 3) / 12.0;  // walks: 1 rad/s/sqrt(s), 5 m/s^2/sqrt(s)
  EXPECT_NEAR(gap(Index::kRotation, Index::kRotation), bridge, 0.01 * bridge);
  EXPECT_NEAR(gap(Index::kVelocity, Index::kVelocity), 25 * bridge, 0.25 * bridge);

  const Preintegration without_gap =
      Integrate(ConstantMotion(Vector3d::Zero(), Vector3d::Zero(), 0.2, 200));
  EXPECT_FALSE(without_gap.HasGap());
  const Matrix15d sampled = without_gap.Covariance();
  EXPECT_GT(gap(Index::kPosition, Index::kPosition),
            100 * sampled(Index::kPosition, Index::kPosition));
}

TEST(Preintegration, DoubtfulReadingAddsItsNoiseOverItsInterval) {
  std::vector<ImuSample> samples = ConstantMotion(Vector3d::Zero(), Vector3d::Zero(), 0.1, 200);
  const Matrix15d sure = Integrate(samples).Covariance();
  samples[10].gyro_doubt = 4;
  samples[10].accel_doubt = 20;
  const Matrix15d doubtful = Integrate(samples).Covariance();
  const double share = std::pow(0.005, 2);  // its error lasts for the sample's interval
  const Matrix15d added = doubtful - sure;
  EXPECT_NEAR(added(Index::kRotation, Index::kRotation), 16 * share, 0.01 * 16 * share);
  EXPECT_NEAR(added(Index::kVelocity, Index::kVelocity), 400 * share, 0.01 * 400 * share);
  EXPECT_NEAR(added(Index::kGyroBias, Index::kGyroBias), 0, 1e-15);
}

TEST(Preintegration, ABiasStepActsFromTheStartOfTheInterval) {
  Preintegration motion = Integrate(ConstantMotion(Vector3d::Zero(), Vector3d::Zero(), 0.1, 200));
  const Matrix15d before = motion.Covariance();
  motion.AllowBiasStep({0.2, 0.5});
  const Matrix15d added = motion.Covariance() - before;
  EXPECT_NEAR(added(Index::kGyroBias, Index::kGyroBias), 0.04, 1e-12);
  EXPECT_NEAR(added(Index::kAccelBias, Index::kAccelBias), 0.25, 1e-12);
  EXPECT_NEAR(added(Index::kRotation, Index::kRotation), 0.04 * 0.01, 1e-9);
  EXPECT_NEAR(added(Index::kVelocity, Index::kVelocity), 0.25 * 0.01, 1e-9);
  const Matrix15d whitened =
      motion.SqrtInformation() * motion.Covariance() * motion.SqrtInformation().transpose();
  EXPECT_MATRIX_NEAR(whitened, Matrix15d::Identity(), 1e-6);
}

TEST(Preintegration, NoiseChangesOnlyTheCovariance) {
  const std::vector<ImuSample> samples = Flight(3.0, 3.2);
  Preintegration reweighed = Integrate(samples);
  reweighed.AllowBiasStep({0.1, 0.2});
  reweighed.SqrtInformation();
  const ImuNoise noise = Scaled(reweighed.noise(), 9);
  const Eigen::Vector3d delta_v = reweighed.delta_v();
  reweighed.Reweigh(noise);
  Preintegration expected = Integrate(samples, reweighed.linearization_bias(), noise);
  EXPECT_FALSE(expected.HasBiasStep());
  expected.AllowBiasStep({0.1, 0.2});
  EXPECT_TRUE(reweighed.HasBiasStep());
  EXPECT_EQ(reweighed.delta_v(), delta_v);
  EXPECT_EQ(reweighed.Covariance(), expected.Covariance());
  EXPECT_EQ(reweighed.SqrtInformation(), expected.SqrtInformation());
}

TEST(Preintegration, JoinedIntervalsKeepTheirNoiseAndSteps) {
  const auto samples = ConstantMotion(Vector3d::Zero(), Vector3d::Zero(), 0.1, 200);
  const std::vector<ImuSample> first(samples.begin(), samples.begin() + 11);
  const std::vector<ImuSample> second(samples.begin() + 10, samples.end());
  Preintegration joined = Integrate(first);
  const double alone = joined.Covariance()(Index::kVelocity, Index::kVelocity);
  Preintegration noisy(Scaled(joined.noise(), 9), {});
  for (const ImuSample& sample : second) noisy.Append(sample);
  noisy.AllowBiasStep({0.1, 0});
  EXPECT_TRUE(joined.HasOneNoise());
  joined.Join(noisy);
  EXPECT_FALSE(joined.HasOneNoise());
  EXPECT_EQ(joined.samples().size(), samples.size());
  EXPECT_EQ(joined.bias_step().gyro, 0.1);
  EXPECT_NEAR(joined.Covariance()(Index::kVelocity, Index::kVelocity), (1 + 9) * alone,
              0.05 * alone);
}

// Joining keeps the greater noise of the two intervals.
TEST(Preintegration, ReintegratedJoinedIntervalsHaveTheGreaterNoise) {
  const auto samples = ConstantMotion(Vector3d::Zero(), Vector3d::Zero(), 0.1, 200);
  const ImuNoise usual, high = Scaled(usual, 9);
  Preintegration whole(high, {});
  for (const ImuSample& sample : samples) whole.Append(sample);
  for (const auto& [earlier, later] : {std::pair(usual, high), std::pair(high, usual)}) {
    Preintegration joined(earlier, {}), next(later, {});
    for (size_t i = 0; i <= 10; ++i) joined.Append(samples[i]);
    for (size_t i = 10; i < samples.size(); ++i) next.Append(samples[i]);
    joined.Join(next);
    joined.Repropagate({});
    EXPECT_TRUE(joined.HasOneNoise());
    EXPECT_MATRIX_NEAR(joined.Covariance(), whole.Covariance(), 1e-15);
  }
}

// The timestamp between two joined intervals no longer matters.
TEST(Preintegration, JoinedIntervalsHaveTheStampErrorsOfTheirEnds) {
  const std::vector<ImuSample> samples = Flight(3.0, 3.4);
  const std::vector<ImuSample> first(samples.begin(), samples.begin() + 41);
  const std::vector<ImuSample> second(samples.begin() + 40, samples.end());
  const Vector15d start = 1e-3 * Vector15d::LinSpaced(1, 15), end = 2 * start;
  Preintegration whole = Integrate(samples), joined = Integrate(first), next = Integrate(second);
  const Eigen::Quaterniond R_B0_B1 = joined.delta_q();
  joined.AllowStampErrors({start, Vector15d::Constant(7)});
  next.AllowStampErrors({Vector15d::Constant(7), end});
  joined.Join(next);
  Vector15d turned = end;
  turned.head<3>() = R_B0_B1 * end.head<3>();
  turned.segment<3>(Index::kVelocity) = R_B0_B1 * end.segment<3>(Index::kVelocity);
  const Vector15d moved = whole.jacobian() * start;
  EXPECT_MATRIX_NEAR(joined.Covariance(),
                     whole.Covariance() + moved * moved.transpose() + turned * turned.transpose(),
                     1e-12);
}

TEST(Preintegration, CovarianceHardlyDependsOnTheSampleRate) {
  const Matrix15d slow = Integrate(Flight(3.0, 3.5, 100)).Covariance();
  const Matrix15d fast = Integrate(Flight(3.0, 3.5, 1000)).Covariance();
  for (int i = 0; i < 15; ++i) EXPECT_NEAR(slow(i, i) / fast(i, i), 1.0, 0.03) << i;
}

}  // namespace
}  // namespace plm_vins
