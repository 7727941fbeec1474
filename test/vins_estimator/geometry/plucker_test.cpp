// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/plucker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;
using Line = Eigen::Matrix<double, kLineSize, 1>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d Stack(const PluckerLine& line) {
  Vector6d coordinates;
  coordinates << line.moment, line.direction;
  return coordinates;
}

// One of the two unit vectors that represent the line.
Vector6d Normalized(const PluckerLine& line) { return Stack(line).normalized(); }

Line ToVector(const PluckerLine& line) {
  return Eigen::Map<const Line>(ToOrthonormal(line).data());
}

PluckerLine RandomLine(simulator::Random* random) {
  const Vector3d start = 3 * random->NormalVector3();
  return LineThrough(start, start + random->NormalVector3());
}

Line Plus(const Line& line, const Vector4d& delta) {
  Line moved;
  LinePlus(line.data(), delta.data(), moved.data());
  return moved;
}

Vector4d RandomTangent(double scale, simulator::Random* random) {
  const Vector3d turn = random->NormalVector3();
  return scale * Vector4d(turn.x(), turn.y(), turn.z(), random->Normal());
}

TEST(PluckerLine, ContainsAllPointsOnTheLine) {
  const Vector3d start(1, 2, 3), end(2, 0, 4);
  const PluckerLine line = LineThrough(start, end);
  EXPECT_MATRIX_NEAR(line.direction, Vector3d(1, -2, 1), 0.0);
  for (const double place : {-3.0, 0.0, 0.4, 1.0, 5.0}) {
    const Vector3d point = start + place * (end - start);
    EXPECT_MATRIX_NEAR(point.cross(line.direction), line.moment, 1e-12) << place;
  }
  EXPECT_NEAR(line.moment.dot(line.direction), 0, 1e-12);
}

TEST(PluckerLine, MomentIsTheImageOfTheLine) {
  const Vector3d start(0.3, -0.2, 3), end(-0.5, 0.4, 5);
  const Vector3d moment = LineThrough(start, end).moment;
  for (const double place : {0.0, 0.3, 1.0}) {
    const Vector3d point = start + place * (end - start);
    EXPECT_NEAR(moment.dot(point / point.z()), 0, 1e-12);
  }
}

TEST(PluckerLine, IntersectsTwoPlanes) {
  simulator::Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3d a = random.NormalVector3(), b = random.NormalVector3();
    const double alpha = random.Normal(), beta = random.Normal();
    const PluckerLine line = Intersection(a, alpha, b, beta);
    const Vector3d point = NearestToOrigin(line) + 1.7 * line.direction;
    EXPECT_NEAR(a.dot(point), alpha, 1e-9);
    EXPECT_NEAR(b.dot(point), beta, 1e-9);
    EXPECT_MATRIX_NEAR(point.cross(line.direction), line.moment, 1e-9);
  }
}

TEST(PluckerLine, ParallelPlanesHaveNoIntersection) {
  const Vector3d normal = Vector3d::UnitX();
  EXPECT_EQ(Intersection(normal, 1, normal, 2).direction.norm(), 0);
}

TEST(PluckerLine, TransformsAsItsPointsDo) {
  simulator::Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Rigid3d T_A_B(SO3Exp(random.NormalVector3()), random.NormalVector3());
    const Vector3d start_B = random.NormalVector3(), end_B = random.NormalVector3();
    const PluckerLine line_A = T_A_B * LineThrough(start_B, end_B);
    const PluckerLine expected = LineThrough(T_A_B * start_B, T_A_B * end_B);
    EXPECT_MATRIX_NEAR(Stack(line_A), Stack(expected), 1e-12);
    EXPECT_MATRIX_NEAR(Stack(T_A_B.Inverse() * line_A), Stack(LineThrough(start_B, end_B)), 1e-12);
  }
}

TEST(PluckerLine, NearestPointStandsSquareOnTheLine) {
  EXPECT_MATRIX_NEAR(NearestToOrigin(LineThrough({5, 2, 3}, {-1, 2, 3})), Vector3d(0, 2, 3), 1e-12);
  simulator::Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const PluckerLine line = RandomLine(&random);
    const Vector3d nearest = NearestToOrigin(line);
    EXPECT_NEAR(nearest.dot(line.direction), 0, 1e-12);
    EXPECT_MATRIX_NEAR(nearest.cross(line.direction), line.moment, 1e-12);
  }
}

TEST(PluckerLine, MeetsPlanesThroughTheOrigin) {
  simulator::Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const PluckerLine line = RandomLine(&random);
    const Vector3d normal = random.NormalVector3();
    const Vector3d point = PointInPlane(line, normal);
    EXPECT_NEAR(normal.dot(point), 0, 1e-9);
    EXPECT_MATRIX_NEAR(point.cross(line.direction), line.moment, 1e-9);
  }
  EXPECT_FALSE(PointInPlane(LineThrough({1, 0, 2}, {1, 3, 2}), Vector3d::UnitX()).allFinite());
}

TEST(OrthonormalLine, RepresentsTheSameLine) {
  simulator::Random random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const PluckerLine line = RandomLine(&random);
    const Line coordinates = ToVector(line);
    EXPECT_NEAR(coordinates.head<4>().norm(), 1, 1e-12);
    EXPECT_GT(coordinates[4], 0);
    EXPECT_LT(coordinates[4], M_PI / 2);
    const PluckerLine back = ToPlucker(coordinates.data());
    EXPECT_MATRIX_NEAR(Stack(back), Normalized(line), 1e-12);
  }
}

TEST(OrthonormalLine, HoldsNearAndFarLines) {
  for (const double distance : {1e-6, 1.0, 1e6}) {
    const PluckerLine line = LineThrough({0, distance, 0}, {1, distance, 0});
    const PluckerLine back = ToPlucker(ToOrthonormal(line).data());
    EXPECT_NEAR(back.moment.norm() / back.direction.norm() / distance, 1, 1e-9);
    EXPECT_MATRIX_NEAR(back.direction.normalized(), Vector3d::UnitX(), 1e-9);
  }
}

TEST(OrthonormalLine, RejectsDegenerateLinesAndLinesThroughTheOrigin) {
  const double nan = std::nan("");
  EXPECT_THROW(ToOrthonormal(LineThrough({1, 2, 3}, {2, 4, 6})), std::invalid_argument);
  EXPECT_THROW(ToOrthonormal(LineThrough({1, 2, 3}, {1, 2, 3})), std::invalid_argument);
  EXPECT_THROW(ToOrthonormal({Vector3d(nan, 0, 0), Vector3d::UnitX()}), std::invalid_argument);
  EXPECT_THROW(ToOrthonormal({Vector3d::UnitX(), Vector3d(0, nan, 0)}), std::invalid_argument);
}

TEST(LinePlus, MovesWithinTheLines) {
  simulator::Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const Line moved = Plus(ToVector(RandomLine(&random)), RandomTangent(1, &random));
    const PluckerLine line = ToPlucker(moved.data());
    EXPECT_NEAR(moved.head<4>().norm(), 1, 1e-12);
    EXPECT_NEAR(line.moment.dot(line.direction), 0, 1e-12);
    EXPECT_NEAR(Stack(line).norm(), 1, 1e-12);
  }
}

TEST(LinePlus, IsInvertedByMinus) {
  simulator::Random random(8);
  for (int trial = 0; trial < 50; ++trial) {
    const Line x = ToVector(RandomLine(&random)), y = ToVector(RandomLine(&random));
    const Vector4d delta = RandomTangent(0.5, &random);
    Vector4d back, between;
    LineMinus(Plus(x, delta).data(), x.data(), back.data());
    EXPECT_MATRIX_NEAR(back, delta, 1e-12);
    LineMinus(y.data(), x.data(), between.data());
    EXPECT_MATRIX_NEAR(Stack(ToPlucker(Plus(x, between).data())), Stack(ToPlucker(y.data())), 1e-9);
  }
}

// Each of the four tangent directions has the effect described in [Bartoli2005].
TEST(LinePlus, HasATangentForEveryFreedom) {
  const PluckerLine line = LineThrough({0, 2, 0}, {1, 2, 0});  // moment along -z
  const Line x = ToVector(line);
  const auto moved = [&x](int axis) {
    const Line y = Plus(x, 0.01 * Vector4d::Unit(axis));
    return ToPlucker(y.data());
  };
  const auto distance = [](const PluckerLine& l) { return l.moment.norm() / l.direction.norm(); };
  const auto turned = [&line](const Vector3d PluckerLine::*part, const PluckerLine& l) {
    return std::asin((l.*part).normalized().cross((line.*part).normalized()).norm());
  };
  EXPECT_NEAR(turned(&PluckerLine::direction, moved(0)), 0.01, 1e-9);  // about the moment
  EXPECT_NEAR(turned(&PluckerLine::moment, moved(0)), 0, 1e-9);
  EXPECT_NEAR(turned(&PluckerLine::moment, moved(1)), 0.01, 1e-9);  // about the direction
  EXPECT_NEAR(turned(&PluckerLine::direction, moved(1)), 0, 1e-9);
  EXPECT_NEAR(turned(&PluckerLine::direction, moved(2)), 0.01, 1e-9);  // about the nearest point
  EXPECT_NEAR(turned(&PluckerLine::moment, moved(2)), 0.01, 1e-9);
  for (const int axis : {0, 1, 2}) EXPECT_NEAR(distance(moved(axis)), 2, 1e-9);
  EXPECT_NEAR(distance(moved(3)), 1 / std::tan(std::atan2(1, 2) + 0.01), 1e-9);
}

TEST(ToPluckerJacobian, IsTheDerivativeThroughPlus) {
  simulator::Random random(9);
  for (int trial = 0; trial < 20; ++trial) {
    const Line x = ToVector(RandomLine(&random));
    const Eigen::MatrixXd numeric = testing::NumericJacobian(
        [](const Line& line) { return Eigen::VectorXd(Stack(ToPlucker(line.data()))); }, x,
        kLineTangentSize, &Plus);
    const PluckerJacobian J = ToPluckerJacobian(x.data());
    EXPECT_MATRIX_NEAR(J.d_moment, numeric.topRows<3>(), 1e-9);
    EXPECT_MATRIX_NEAR(J.d_direction, numeric.bottomRows<3>(), 1e-9);
  }
}

}  // namespace
}  // namespace plm_vins
