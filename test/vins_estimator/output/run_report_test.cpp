// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/measurements.h"

namespace plm_vins {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RunReportTest : public ::testing::Test {
 protected:
  // Outputs every tenth of a second until the time, all alike.
  void Until(double end, const EstimatorOutput& output) {
    for (; time_ < end - 0.01; time_ += 0.1) {
      EstimatorOutput next = output;
      next.t_ns = ToNanoseconds(100 + time_);
      report_.Add(next);
    }
  }

  static EstimatorOutput Without(const std::string& reason) {
    EstimatorOutput output;
    output.reason = reason;
    return output;
  }
  static EstimatorOutput Pose() {
    EstimatorOutput output;
    output.has_pose = true;
    return output;
  }
  void Restart(const std::string& reason) {
    EstimatorOutput output = Without(reason);
    output.restarted = true;
    Until(time_ + 0.1, output);
  }

  RunReport report_;
  double time_ = 0;  // [s]
};

TEST_F(RunReportTest, GoodRunHasOneWorld) {
  Until(1.6, Without("collecting images: 0.1 s of 1.5 s"));
  Until(10, Pose());
  EXPECT_THAT(report_.Lines(std::nullopt),
              ElementsAre("1 world frame: from 1.60 s on",
                          "no pose for 1.5 of 9.9 s: collecting images (1.5 s)"));
  EXPECT_THAT(report_.LastRestart(), IsEmpty());
}

TEST_F(RunReportTest, StatesReasonsOfNewWorldsAndMissingPoses) {
  Until(1, Without("collecting images: 0.1 s of 1.5 s"));
  Until(5, Pose());
  Restart("velocity is 60 m/s");
  Until(15, Without("scale not observable yet: uncertain by 9 %"));
  Until(20, Pose());
  time_ += 3;  // no image
  Until(25, Pose());
  EXPECT_THAT(report_.Lines(ToNanoseconds(99)),
              ElementsAre("2 unconnected world frames: from 2.00 s on; from 16.00 s on (velocity "
                          "is 60 m/s)",
                          "no pose for 15.0 of 25.9 s: scale not observable yet (9.9 s), no usable "
                          "image (3.1 s), collecting images (0.9 s)"));
  EXPECT_EQ(report_.LastRestart(), "velocity is 60 m/s");
}

TEST_F(RunReportTest, CountsImagesAfterTheLastOutput) {
  report_.End(ToNanoseconds(100));
  EXPECT_THAT(report_.Lines(std::nullopt), IsEmpty());
  Until(5, Pose());
  report_.End(ToNanoseconds(112));
  EXPECT_THAT(report_.Lines(std::nullopt),
              ElementsAre("1 world frame: from 0.00 s on",
                          "no pose for 7.1 of 12.0 s: no usable image (7.1 s)"));
  EXPECT_EQ(report_.WhyOftenWithoutPose(), "no usable image");
}

TEST_F(RunReportTest, SaysWhyThereIsOftenNoPose) {
  EXPECT_THAT(report_.WhyOftenWithoutPose(), IsEmpty());
  Until(1, Without("collecting images: 0.1 s of 1.5 s"));
  Until(3, Pose());
  EXPECT_THAT(report_.WhyOftenWithoutPose(), IsEmpty());
  Until(6, Without("the estimated scale is negative: check the signs"));
  EXPECT_EQ(report_.WhyOftenWithoutPose(), "the estimated scale is negative: check the signs");
}

TEST_F(RunReportTest, CollectingImagesIsACauseOnlyWithoutAnother) {
  Until(2, Without("collecting images: 0.1 s of 0.7 s"));
  EXPECT_EQ(report_.WhyOftenWithoutPose(), "collecting images");
  Until(3, Without("implausible accelerometer bias: 3 m/s^2"));
  EXPECT_EQ(report_.WhyOftenWithoutPose(), "implausible accelerometer bias: 3 m/s^2");
}

TEST_F(RunReportTest, WithoutAnyPoseHasNoWorld) {
  EXPECT_THAT(report_.Lines(std::nullopt), IsEmpty());
  Until(1, Without("too little parallax: 1 px of 15 px"));
  EXPECT_THAT(report_.Lines(std::nullopt),
              ElementsAre("no pose for 0.9 of 0.9 s: too little parallax (0.9 s)"));
}

TEST_F(RunReportTest, AddsUpReasonsThatDifferInFiguresOnly) {
  for (int i = 0; i < 20; ++i) {
    Until(time_ + 0.1, Without("estimated gravity is " + std::to_string(i / 7.0) + " m/s^2"));
  }
  EXPECT_THAT(report_.Lines(std::nullopt),
              ElementsAre("no pose for 1.9 of 1.9 s: estimated gravity is N m/s^2 (1.9 s)"));
}

TEST_F(RunReportTest, NamesTheFirstOfManyWorlds) {
  for (int i = 0; i < 8; ++i) {
    if (i > 0) Restart("lost");
    Until(time_ + 1, Pose());
  }
  EXPECT_THAT(report_.Lines(std::nullopt).front(),
              ::testing::AllOf(::testing::StartsWith("8 unconnected world frames"),
                               ::testing::EndsWith("; and 3 more")));
}

}  // namespace
}  // namespace plm_vins
