// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/line_triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Result = LineTriangulationResult;

constexpr double kEndNoise = 1.0 / 460.0;

const Vector3d kAlong = Vector3d::UnitX();  // direction of the line in most tests
const Vector3d kAcross = Vector3d::UnitY();
const Vector3d kTowards = Vector3d::UnitZ();

struct Segment {
  Vector3d start{-1, 0, 4}, end{1, 0, 4};  // four meters ahead of a camera at the origin
};

// Observation of a segment by a camera, with `noise` at its endpoints.
PosedLineObservation See(const Segment& segment, const Rigid3d& T_W_C, double noise = 0,
                         simulator::Random* random = nullptr) {
  const auto see = [&](const Vector3d& p_W) -> Vector2d {
    Vector2d xy = (T_W_C.Inverse() * p_W).hnormalized();
    if (random == nullptr) return xy;
    const double u = random->Normal(), v = random->Normal();
    return xy + noise * Vector2d(u, v);
  };
  return {T_W_C, {see(segment.start), see(segment.end)}};
}

// Ten observations from cameras that move by `travel` in total and rotate slightly.
std::vector<PosedLineObservation> SeeOnTheWay(const Vector3d& travel, double noise, uint64_t seed,
                                              const Segment& segment = {}) {
  constexpr int kViews = 10;
  simulator::Random random(seed);
  std::vector<PosedLineObservation> observations;
  for (int i = 0; i < kViews; ++i) {
    const Rigid3d T_W_C(SO3Exp(0.05 * random.NormalVector3()), i / (kViews - 1.0) * travel);
    observations.push_back(See(segment, T_W_C, noise, &random));
  }
  return observations;
}

// Distance of a world point from the line triangulated in the first camera.
double Distance(const Vector3d& p_W, const TriangulatedLine& found,
                const std::vector<PosedLineObservation>& observations) {
  const PluckerLine line_W = observations.front().T_W_C * ToPlucker(found.line.data());
  return (p_W.cross(line_W.direction) - line_W.moment).norm() / line_W.direction.norm();
}

Result ResultOf(const std::vector<PosedLineObservation>& observations, double noise = kEndNoise) {
  return TriangulateLine(LineTriangulationOptions(noise), observations).result;
}

// Number of the `trials` noisy flights that yield a line.
int CountAccepted(const Vector3d& travel, int trials) {
  int accepted = 0;
  for (int seed = 1; seed <= trials; ++seed) {
    accepted += ResultOf(SeeOnTheWay(travel, kEndNoise, seed)) == Result::kOk;
  }
  return accepted;
}

TEST(TriangulateLine, IsExactWithoutNoise) {
  simulator::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Rigid3d T_W_A(SO3Exp(random.NormalVector3()), random.NormalVector3());
    const auto point = [&] {
      const double x = random.Normal(), y = random.Normal();
      return T_W_A * Vector3d(x, y, random.Uniform(4, 8));
    };
    const Segment segment{point(), point()};
    std::vector<PosedLineObservation> observations;
    for (int i = 0; i < 5; ++i) {
      const Rigid3d T_A_C(SO3Exp(0.1 * random.NormalVector3()), 0.5 * random.NormalVector3());
      observations.push_back(See(segment, T_W_A * T_A_C));
    }
    const TriangulatedLine found = TriangulateLine(LineTriangulationOptions(1e-4), observations);
    ASSERT_EQ(found.result, Result::kOk) << trial;
    EXPECT_LT(Distance(segment.start, found, observations), 1e-5);
    EXPECT_LT(Distance(segment.end, found, observations), 1e-5);
  }
}

TEST(TriangulateLine, ObservationsMayShowDifferentPartsInEitherOrder) {
  const Segment whole{{-2, 0, 4}, {2, 1, 5}};
  const auto part = [&](double from, double to) -> Segment {
    return {whole.start + from * (whole.end - whole.start),
            whole.start + to * (whole.end - whole.start)};
  };
  const std::vector<PosedLineObservation> observations = {
      See(part(0.0, 0.4), {SO3Exp({0, 0, 0}), {0, 0, 0}}),
      See(part(0.9, 0.5), {SO3Exp({0, 0.1, 0}), {0, 0.5, 0}}),
      See(part(0.2, 0.3), {SO3Exp({0.1, 0, 0}), {0, 1, 0}}),
  };
  const TriangulatedLine found = TriangulateLine(LineTriangulationOptions(1e-4), observations);
  ASSERT_EQ(found.result, Result::kOk);
  EXPECT_LT(Distance(whole.start, found, observations), 1e-6);
  EXPECT_LT(Distance(whole.end, found, observations), 1e-6);
}

// The error equals the propagated noise, which is the lower bound of any estimator.
TEST(TriangulateLine, ErrorMatchesTheNoise) {
  constexpr int kTrials = 400;
  double nees = 0;
  for (int seed = 1; seed <= kTrials; ++seed) {
    const auto observations = SeeOnTheWay({0.2, 0.8, 0.1}, kEndNoise, seed);
    const TriangulatedLine found =
        TriangulateLine(LineTriangulationOptions(kEndNoise), observations);
    ASSERT_EQ(found.result, Result::kOk);
    const auto fit = EvaluateLine(observations, kEndNoise, found.line);
    ASSERT_TRUE(fit);
    const Rigid3d T_C0_W = observations.front().T_W_C.Inverse();
    const OrthonormalLine truth =
        ToOrthonormal(T_C0_W * LineThrough(Segment().start, Segment().end));
    Eigen::Vector4d error;
    LineMinus(truth.data(), found.line.data(), error.data());
    nees += error.dot(fit->information * error) / kTrials;
  }
  EXPECT_NEAR(nees, 4.0, 0.6);  // four standard deviations of the mean
}

TEST(TriangulateLine, NeedsTwoObservations) {
  EXPECT_EQ(ResultOf({}), Result::kDegenerate);
  EXPECT_EQ(ResultOf({See({}, Rigid3d())}), Result::kDegenerate);
  EXPECT_EQ(ResultOf({See({}, Rigid3d()), See({}, {SO3Exp({0, 0, 0}), kAcross})}), Result::kOk);
}

// Repeated poses, pure rotations, and motions in the plane of camera and line: exactly degenerate,
// with possible divisions by zero.
TEST(TriangulateLine, RejectsExactDegeneracy) {
  for (const Vector3d& travel :
       {Vector3d(0, 0, 0), kAlong, kTowards, Vector3d(kAlong + kTowards), Vector3d(-kAlong)}) {
    for (const bool turns : {false, true}) {
      std::vector<PosedLineObservation> observations;
      for (int i = 0; i < 4; ++i) {
        const Vector3d turn = turns ? Vector3d(0.02 * i, -0.01 * i, 0.03 * i) : Vector3d(0, 0, 0);
        observations.push_back(See({}, {SO3Exp(turn), 0.2 * i * travel}));
      }
      for (const double noise : {1e-6, kEndNoise}) {
        EXPECT_EQ(ResultOf(observations, noise), Result::kDegenerate)
            << travel.transpose() << (turns ? " with turns" : "");
      }
    }
  }
}

// Noise between identical planes must not be confused with depth.
TEST(TriangulateLine, IsNotFooledByNoiseInDegeneracy) {
  constexpr int kTrials = 300;
  EXPECT_EQ(CountAccepted(Vector3d::Zero(), kTrials), 0);
  EXPECT_LE(CountAccepted(kAlong, kTrials), kTrials / 100);
  EXPECT_LE(CountAccepted(kTowards, kTrials), kTrials / 100);
  EXPECT_LE(CountAccepted(kAlong + kTowards, kTrials), kTrials / 100);
}

TEST(TriangulateLine, AcceptsMotionAcrossTheLine) {
  constexpr int kTrials = 300;
  EXPECT_EQ(CountAccepted(0.5 * kAcross, kTrials), kTrials);
  EXPECT_EQ(CountAccepted(0.5 * kAcross + kAlong, kTrials), kTrials);
}

// Noise rotates the planes of short segments about the line of sight by more than the parallax.
TEST(TriangulateLine, AcceptsShortLines) {
  const Segment segment{{-0.2, 0.1, 4}, {0.1, -0.1, 4.1}};  // 45 pixels
  for (int seed = 1; seed <= 300; ++seed) {
    const auto observations = SeeOnTheWay(0.3 * kAcross, kEndNoise, seed, segment);
    EXPECT_EQ(ResultOf(observations), Result::kOk) << seed;
  }
}

TEST(TriangulateLine, WaitsForABaselineThatRisesAboveTheNoise) {
  // Parallax of the whole path relative to the noise: 4.6, 460.
  for (const double noise : {0.1 * kEndNoise, kEndNoise}) {
    EXPECT_EQ(ResultOf(SeeOnTheWay(2 * noise * kAcross, 0, 1), noise), Result::kDegenerate);
    EXPECT_EQ(ResultOf(SeeOnTheWay(200 * noise * kAcross, 0, 1), noise), Result::kOk);
  }
}

TEST(TriangulateLine, RejectsTheSameGeometryWithMoreNoise) {
  const auto observations = SeeOnTheWay(0.2 * kAcross, 0, 1);
  EXPECT_EQ(ResultOf(observations, 0.3 * kEndNoise), Result::kOk);
  EXPECT_EQ(ResultOf(observations, 10 * kEndNoise), Result::kDegenerate);
  // The standard deviation of the depth is proportional to the noise.
  const auto is_known = [&](double max_deviation, double noise) {
    LineTriangulationOptions options(noise);
    options.max_depth_deviation = max_deviation;
    return TriangulateLine(options, observations).result == Result::kOk;
  };
  double limit = 1e-4;
  while (!is_known(limit, kEndNoise)) limit *= 1.01;
  EXPECT_TRUE(is_known(10.2 * limit, 10 * kEndNoise));
  EXPECT_FALSE(is_known(9.8 * limit, 10 * kEndNoise));
}

// The depth errors of barely accepted lines agree with the permitted standard deviation.
TEST(TriangulateLine, StatesTheDeviationOfItsDepth) {
  constexpr int kTrials = 400;
  const Vector3d travel = 0.06 * kAcross;
  LineTriangulationOptions options(kEndNoise);
  while (TriangulateLine(options, SeeOnTheWay(travel, 0, 1)).result == Result::kOk) {
    options.max_depth_deviation *= 0.99;
  }
  const double expected = options.max_depth_deviation;
  options.max_depth_deviation = 10;
  std::vector<double> errors;
  for (int seed = 1; seed <= kTrials; ++seed) {
    const auto observations = SeeOnTheWay(travel, kEndNoise, seed);
    const TriangulatedLine found = TriangulateLine(options, observations);
    const LineEnds ends = EndsOf(ToPlucker(found.line.data()), observations.front().segment);
    const double start = (observations.front().T_W_C.Inverse() * Segment().start).z();
    // In inverse depth, whose errors are symmetric.
    errors.push_back(std::abs(start / ends.start.z() - 1));
  }
  std::sort(errors.begin(), errors.end());
  const double deviation = errors[static_cast<size_t>(0.683 * kTrials)];
  EXPECT_GT(deviation, 0.75 * expected);
  EXPECT_LT(deviation, 1.33 * expected);
}

TEST(TriangulateLine, RejectsLinesBehindACamera) {
  // Vertical lines whose planes intersect five meters behind both cameras.
  const auto upright = [](double x) { return SegmentEndPoints{{x, -0.3}, {x, 0.3}}; };
  EXPECT_EQ(ResultOf({{Rigid3d(), upright(-0.1)}, {{SO3Exp({0, 0, 0}), kAlong}, upright(0.1)}}),
            Result::kBehind);
  // A third camera looks the other way; its plane is correct nevertheless.
  const Rigid3d turned(SO3Exp({0, M_PI, 0}), 2 * kAcross);
  EXPECT_EQ(ResultOf({See({}, Rigid3d()), See({}, {SO3Exp({0, 0, 0}), kAcross}), See({}, turned)}),
            Result::kBehind);
}

TEST(TriangulateLine, RejectsContradictingObservations) {
  auto observations = SeeOnTheWay(kAcross, kEndNoise, 1);
  EXPECT_EQ(ResultOf(observations), Result::kOk);
  // Half of the observations are of another, parallel line.
  const Segment other{Segment().start + 0.3 * kAcross, Segment().end + 0.3 * kAcross};
  for (size_t i = 0; i < observations.size(); i += 2) {
    observations[i] = See(other, observations[i].T_W_C);
  }
  EXPECT_EQ(ResultOf(observations), Result::kInconsistent);
}

TEST(TriangulateLine, SurvivesSegmentsWithoutLengthOrNumbers) {
  const double nan = std::nan("");
  const auto observations = SeeOnTheWay(kAcross, kEndNoise, 1);
  for (const SegmentEndPoints& bad :
       {SegmentEndPoints{{0.1, 0.2}, {0.1, 0.2}}, SegmentEndPoints{{nan, 0}, {1, 0}}}) {
    for (const size_t place : {size_t{0}, size_t{4}}) {
      auto with_bad = observations;
      with_bad[place].segment = bad;
      const TriangulatedLine found = TriangulateLine(LineTriangulationOptions(kEndNoise), with_bad);
      if (found.result != Result::kOk) continue;
      for (const double value : found.line) EXPECT_TRUE(std::isfinite(value));
    }
    EXPECT_NE(ResultOf(std::vector<PosedLineObservation>(3, {Rigid3d(), bad})), Result::kOk);
  }
}

TEST(EndsOf, AreTheObservedPoints) {
  simulator::Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3d start(random.Normal(), random.Normal(), random.Uniform(3, 8));
    const Vector3d end(random.Normal(), random.Normal(), random.Uniform(3, 8));
    const LineEnds ends = EndsOf(LineThrough(start, end), {start.hnormalized(), end.hnormalized()});
    EXPECT_MATRIX_NEAR(ends.start, start, 1e-9);
    EXPECT_MATRIX_NEAR(ends.end, end, 1e-9);
    EXPECT_TRUE(IsInFront(ends));
    EXPECT_FALSE(IsInFront({-start, end}));
    EXPECT_FALSE(IsInFront({start, -end}));
  }
}

TEST(EndsOf, DropPerpendicularsInTheImage) {
  const PluckerLine line = LineThrough({0, 0, 2}, {1, 0, 2});  // y = 0 in the image
  const LineEnds ends = EndsOf(line, {{0.1, 0.01}, {0.4, 0.01}});
  EXPECT_MATRIX_NEAR(ends.start, Vector3d(0.2, 0, 2), 1e-9);
  EXPECT_MATRIX_NEAR(ends.end, Vector3d(0.8, 0, 2), 1e-9);
}

TEST(IsInFront, IsFalseWithoutNumbers) {
  const Vector3d seen(0, 0, 2), unknown = Vector3d::Constant(std::nan(""));
  EXPECT_FALSE(IsInFront({seen, unknown}));
  EXPECT_FALSE(IsInFront({unknown, seen}));
}

}  // namespace
}  // namespace plm_vins
