// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/manhattan/manhattan_frame.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <vector>

#include "common/geometry/so3.h"
#include "common/measurements.h"
#include "simulator/random.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using simulator::Random;

constexpr double kOneDegree = M_PI / 180;
constexpr double kFrameInterval = 0.1;  // [s]

Vector3d Horizontal(double heading) { return {std::cos(heading), std::sin(heading), 0}; }

Vector3d Noisy(const Vector3d& direction, double sigma, Random* random) {
  return (direction + sigma * random->NormalVector3()).normalized();
}

Vector3d AnyDirection(Random* random) { return random->NormalVector3().normalized(); }

Vector3d AnyHorizontal(Random* random) { return Horizontal(random->Uniform(0, M_PI)); }

// A direction along one of the axes of a man-made scene, of either sign.
Vector3d Along(double heading, Random* random) {
  const double sign = random->Uniform() < 0.5 ? -1 : 1;
  const int axis = random->Index(3);
  if (axis == 2) return sign * Vector3d::UnitZ();
  return sign * Horizontal(heading + axis * M_PI / 2);
}

// A stream of lines: 30 are visible, each for about two seconds, and then replaced by a new one.
class LineStream {
 public:
  using MakeDirection = std::function<Vector3d(Random*)>;

  LineStream(uint64_t seed, double sigma) : random_(seed), sigma_(sigma) {}

  // Adds frames for `seconds`, with new lines drawn by `make`, observed in a world that rotates by
  // `yaw_rate` [rad/s].
  void Feed(double seconds, const MakeDirection& make, ManhattanFrame* frame, double yaw_rate = 0) {
    const int frames = static_cast<int>(seconds / kFrameInterval);
    for (int i = 0; i < frames; ++i) {
      yaw_ += yaw_rate * kFrameInterval;
      Replace(make);
      std::vector<LineDirection> seen;
      const Eigen::AngleAxisd turn(yaw_, Vector3d::UnitZ());
      for (const auto& [id, direction] : lines_) {
        seen.push_back({id, turn * Noisy(direction, 0.2 * sigma_, &random_), sigma_});
      }
      t_ += kFrameInterval;
      frame->Update(ToNanoseconds(t_), seen);
    }
  }

  double yaw() const { return yaw_; }

 private:
  void Replace(const MakeDirection& make) {
    for (auto it = lines_.begin(); it != lines_.end();) {
      it = random_.Uniform() < 0.05 ? lines_.erase(it) : std::next(it);
    }
    while (lines_.size() < 30) lines_[next_id_++] = Noisy(make(&random_), sigma_, &random_);
  }

  Random random_;
  double sigma_;
  std::map<int64_t, Vector3d> lines_;
  int64_t next_id_ = 0;
  double t_ = 0, yaw_ = 0;
};

double HeadingError(const ManhattanFrame& frame, double heading) {
  return std::abs(WrapQuarterTurn(Yaw(*frame.R_W_M()) - heading));
}

// A man-made scene with this heading and a share of arbitrary lines.
LineStream::MakeDirection Built(double heading, double outliers) {
  return [=](Random* random) {
    return random->Uniform() < outliers ? AnyDirection(random) : Along(heading, random);
  };
}

TEST(ManhattanFrame, IsAbsentWithoutLines) {
  ManhattanFrame frame;
  for (int i = 0; i < 100; ++i) frame.Update(ToNanoseconds(0.1 * i), {});
  EXPECT_EQ(frame.state(), ManhattanState::kAbsent);
  EXPECT_FALSE(frame.R_W_M());
}

TEST(ManhattanFrame, IsFoundAmongNoiseAndOutliers) {
  for (const double outliers : {0.0, 0.2, 0.4}) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
      const double heading = Random(seed).Uniform(-M_PI, M_PI);
      ManhattanFrame frame;
      LineStream(seed, kOneDegree).Feed(15, Built(heading, outliers), &frame);
      ASSERT_EQ(frame.state(), ManhattanState::kLocked) << "outliers " << outliers;
      EXPECT_LT(HeadingError(frame, heading), 0.6 * kOneDegree);
      EXPECT_NEAR(((*frame.R_W_M()) * Vector3d::UnitZ()).z(), 1, 1e-12);
    }
  }
}

TEST(ManhattanFrame, IsFoundAmongHorizontalOutliers) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    ManhattanFrame frame;
    const auto make = [](Random* random) {
      return random->Uniform() < 0.4 ? AnyHorizontal(random) : Along(0.3, random);
    };
    LineStream(seed, kOneDegree).Feed(15, make, &frame);
    ASSERT_EQ(frame.state(), ManhattanState::kLocked);
    EXPECT_LT(HeadingError(frame, 0.3), 0.6 * kOneDegree);
  }
}

TEST(ManhattanFrame, IsFoundWhereTheHeadingWraps) {
  for (const double heading :
       {-45 * kOneDegree, 45 * kOneDegree, 44.9 * kOneDegree, 135 * kOneDegree}) {
    ManhattanFrame frame;
    LineStream(3, kOneDegree).Feed(15, Built(heading, 0.2), &frame);
    ASSERT_EQ(frame.state(), ManhattanState::kLocked);
    EXPECT_LT(HeadingError(frame, heading), 0.6 * kOneDegree);
  }
}

TEST(ManhattanFrame, IsFoundFromParallelLines) {
  ManhattanFrame frame;
  LineStream(1, kOneDegree)
      .Feed(
          15, [](Random*) { return Horizontal(0.4); }, &frame);
  ASSERT_EQ(frame.state(), ManhattanState::kLocked);
  EXPECT_LT(HeadingError(frame, 0.4), 0.5 * kOneDegree);
}

// The second case is the most difficult one: all lines are horizontal, so all of them vote.
TEST(ManhattanFrame, StaysAbsentAmongRandomLines) {
  for (const auto& make : {&AnyDirection, &AnyHorizontal}) {
    for (uint64_t seed = 1; seed <= 1000; ++seed) {
      ManhattanFrame frame;
      LineStream(seed, kOneDegree).Feed(20, make, &frame);
      ASSERT_FALSE(frame.R_W_M()) << "seed " << seed;
    }
  }
}

TEST(ManhattanFrame, StaysAbsentAmongVerticalLines) {
  ManhattanFrame frame;
  LineStream(1, kOneDegree)
      .Feed(
          20, [](Random*) { return Vector3d(0, 0, -1); }, &frame);
  EXPECT_EQ(frame.state(), ManhattanState::kAbsent);
  EXPECT_EQ(frame.AxisOf({1, -Vector3d::UnitZ(), 0}), LineAxis::kZ);
}

TEST(ManhattanFrame, NeedsSeveralLines) {
  ManhattanFrame frame;
  for (int i = 0; i < 200; ++i) {
    std::vector<LineDirection> lines(4, {0, Horizontal(0.2), 0.1 * kOneDegree});
    for (int id = 0; id < 4; ++id) lines[id].id = id;
    frame.Update(ToNanoseconds(0.1 * i), lines);
  }
  EXPECT_FALSE(frame.R_W_M());
}

TEST(ManhattanFrame, IgnoresInaccurateLines) {
  ManhattanFrame frame;
  LineStream(1, 5 * kOneDegree).Feed(20, Built(0.3, 0), &frame);
  EXPECT_EQ(frame.support().total, 0);
  EXPECT_EQ(frame.AxisOf({1, Vector3d::UnitZ(), 5 * kOneDegree}), LineAxis::kFree);
}

TEST(ManhattanFrame, IsTheOneWithMoreSupport) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    ManhattanFrame frame;
    const auto make = [](Random* random) {
      return Along(random->Uniform() < 0.65 ? 0.1 : 0.5, random);
    };
    LineStream(seed, kOneDegree).Feed(20, make, &frame);
    ASSERT_EQ(frame.state(), ManhattanState::kLocked);
    EXPECT_LT(HeadingError(frame, 0.1), 0.6 * kOneDegree);
  }
}

TEST(ManhattanFrame, IsACandidateFirst) {
  ManhattanFrame frame;
  LineStream stream(1, kOneDegree);
  bool was_candidate = false;
  for (int i = 0; i < 150 && frame.state() != ManhattanState::kLocked; ++i) {
    stream.Feed(0.1, Built(0.3, 0.2), &frame);
    was_candidate |= frame.state() == ManhattanState::kCandidate;
    EXPECT_FALSE(i < 30 && frame.R_W_M());
  }
  EXPECT_TRUE(was_candidate);
  EXPECT_EQ(frame.state(), ManhattanState::kLocked);
}

TEST(ManhattanFrame, DoesNotMoveOnceLocked) {
  ManhattanFrame frame;
  LineStream stream(1, kOneDegree);
  stream.Feed(15, Built(0.3, 0.2), &frame);
  const double locked = Yaw(*frame.R_W_M());
  stream.Feed(20, Built(0.3, 0.2), &frame, /*yaw_rate=*/0.03 * kOneDegree);  // drifts by 0.6 deg
  ASSERT_TRUE(frame.R_W_M());
  EXPECT_EQ(Yaw(*frame.R_W_M()), locked);
}

TEST(ManhattanFrame, StaysWithoutLines) {
  ManhattanFrame frame;
  LineStream stream(1, kOneDegree);
  stream.Feed(15, Built(0.3, 0.2), &frame);
  stream.Feed(
      120, [](Random*) { return Vector3d::UnitZ(); }, &frame);
  EXPECT_EQ(frame.state(), ManhattanState::kLocked);
}

TEST(ManhattanFrame, StaysAmongRandomLines) {
  ManhattanFrame frame;
  LineStream stream(1, kOneDegree);
  stream.Feed(15, Built(0.3, 0.2), &frame);
  stream.Feed(60, &AnyHorizontal, &frame);
  EXPECT_EQ(frame.state(), ManhattanState::kLocked);
}

TEST(ManhattanFrame, IsRevokedAndFoundAgainAfterAHeadingChange) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    ManhattanFrame frame;
    LineStream stream(seed, kOneDegree);
    stream.Feed(15, Built(0.3, 0.2), &frame);
    ASSERT_EQ(frame.state(), ManhattanState::kLocked);
    bool was_revoked = false;
    for (int i = 0; i < 600; ++i) {  // rotates by 6 deg
      stream.Feed(0.1, Built(0.3, 0.2), &frame, 0.1 * kOneDegree);
      was_revoked |= frame.state() == ManhattanState::kRevoked;
    }
    EXPECT_TRUE(was_revoked) << "seed " << seed;
    stream.Feed(40, Built(0.3, 0.2), &frame);
    ASSERT_EQ(frame.state(), ManhattanState::kLocked);
    EXPECT_LT(HeadingError(frame, 0.3 + stream.yaw()), 2 * kOneDegree);
  }
}

TEST(ManhattanFrame, IsReplacedInABuildingOfAnotherHeading) {
  ManhattanFrame frame;
  LineStream stream(1, kOneDegree);
  stream.Feed(15, Built(0.1, 0.2), &frame);
  stream.Feed(100, Built(0.5, 0.2), &frame);
  ASSERT_EQ(frame.state(), ManhattanState::kLocked);
  EXPECT_LT(HeadingError(frame, 0.5), 0.6 * kOneDegree);
}

TEST(ManhattanFrame, NamesTheAxisOfALine) {
  ManhattanFrame frame;
  EXPECT_EQ(frame.AxisOf({1, Vector3d::UnitX(), 0}), LineAxis::kFree);
  EXPECT_EQ(frame.AxisOf({1, Vector3d::UnitZ(), 0}), LineAxis::kZ);
  LineStream(1, 0.1 * kOneDegree).Feed(15, Built(0.3, 0.2), &frame);
  ASSERT_EQ(frame.state(), ManhattanState::kLocked);
  const Eigen::Quaterniond R_W_M = *frame.R_W_M();
  EXPECT_EQ(frame.AxisOf({1, R_W_M * Vector3d::UnitX(), 0}), LineAxis::kX);
  EXPECT_EQ(frame.AxisOf({1, -(R_W_M * Vector3d::UnitY()), 0}), LineAxis::kY);
  EXPECT_EQ(frame.AxisOf({1, Horizontal(0.3 + M_PI / 4), 0}), LineAxis::kFree);
  for (const LineAxis axis : {LineAxis::kX, LineAxis::kY, LineAxis::kZ}) {
    EXPECT_EQ(frame.AxisOf({1, frame.AxisInWorld(axis), 0}), axis);
  }
}

TEST(ManhattanFrame, AllowsForTheUncertaintyOfALine) {
  const ManhattanFrame frame;
  const Vector3d tilted(std::sin(3.5 * kOneDegree), 0, std::cos(3.5 * kOneDegree));
  EXPECT_EQ(frame.AxisOf({1, tilted, 0.1 * kOneDegree}), LineAxis::kFree);
  EXPECT_EQ(frame.AxisOf({1, tilted, 1.0 * kOneDegree}), LineAxis::kZ);
}

}  // namespace
}  // namespace plm_vins
