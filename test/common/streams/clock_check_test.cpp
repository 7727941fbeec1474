// SPDX-License-Identifier: BSD-3-Clause
#include "common/streams/clock_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "common/streams/constant_stamp.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Returns the finding of ten seconds of images at 20 Hz and IMU samples at 200 Hz in order of time.
// `stamp` says how a sensor stamps what it took at a time, in milliseconds; below zero: not at all.
using Stamp = std::function<int64_t(int64_t t_ms)>;

std::string FindingOf(const Stamp& image_stamp, const Stamp& imu_stamp) {
  ClockCheck check;
  for (int64_t t_ms = 10'000; t_ms < 20'000; t_ms += 5) {
    if (imu_stamp(t_ms) >= 0) check.AddImu(imu_stamp(t_ms) * 1'000'000);
    if (t_ms % 50 == 0 && image_stamp(t_ms) >= 0) check.AddImage(image_stamp(t_ms) * 1'000'000);
  }
  return check.Finding("/cam", "/imu");
}

int64_t AsTaken(int64_t t_ms) { return t_ms; }

TEST(ClockCheck, NamesBothStampsAndTheirDifference) {
  EXPECT_THAT(FindingOf([](int64_t t_ms) { return t_ms + 37'000; }, AsTaken),
              AllOf(HasSubstr("(/cam)"), HasSubstr("(/imu)"), HasSubstr("apart by 37.0 s"),
                    HasSubstr("stamp both by one clock")));
  EXPECT_THAT(FindingOf(AsTaken, [](int64_t t_ms) { return t_ms + 1'600'000'000'000; }),
              HasSubstr("apart by -1600000000.0 s"));
  EXPECT_THAT(FindingOf([](int64_t t_ms) { return t_ms - 1500; }, AsTaken),
              HasSubstr("apart by -1.5 s"));
}

TEST(ClockCheck, NoticesAClockThatIsSetInFlight) {
  EXPECT_THAT(FindingOf([](int64_t t_ms) { return t_ms < 14'000 ? t_ms : t_ms + 5000; }, AsTaken),
              HasSubstr("apart by 5.0 s"));
}

TEST(ClockCheck, NoticesRecordingsOneAfterTheOther) {
  ClockCheck check;
  for (int64_t i = 0; i < 200; ++i) check.AddImage(i * 50'000'000);
  for (int64_t i = 0; i < 2000; ++i) check.AddImu(100'000'000'000 + i * 5'000'000);
  EXPECT_THAT(check.Finding("/cam", "/imu"), HasSubstr("different clocks"));
}

TEST(ClockCheck, FaultsPass) {
  EXPECT_THAT(
      FindingOf([](int64_t t_ms) { return t_ms > 12'000 && t_ms < 17'000 ? t_ms + 5000 : t_ms; },
                AsTaken),
      IsEmpty());
}

TEST(ClockCheck, AllowsOffsetsGapsLateStartsAndStalls) {
  const auto missing = [](int64_t begin_ms, int64_t end_ms) {
    return [=](int64_t t_ms) { return t_ms >= begin_ms && t_ms < end_ms ? -1 : t_ms; };
  };
  EXPECT_THAT(FindingOf([](int64_t t_ms) { return t_ms + 700; }, AsTaken), IsEmpty());
  EXPECT_THAT(FindingOf(missing(0, 15'000), AsTaken), IsEmpty());
  EXPECT_THAT(FindingOf(AsTaken, missing(0, 15'000)), IsEmpty());
  EXPECT_THAT(FindingOf(AsTaken, missing(12'000, 16'000)), IsEmpty());
  EXPECT_THAT(FindingOf(missing(12'000, 16'000), AsTaken), IsEmpty());

  ClockCheck check;  // four seconds of images come at once, then as many of the IMU
  for (int64_t i = 0; i < 80; ++i) check.AddImage(i * 50'000'000);
  for (int64_t i = 0; i < 800; ++i) check.AddImu(i * 5'000'000);
  for (int64_t i = 80; i < 160; ++i) check.AddImage(i * 50'000'000);
  EXPECT_THAT(check.Finding("/cam", "/imu"), IsEmpty());
}

// Whole seconds, tenths or twentieths of images at 20 Hz.
TEST(ConstantStamp, NamesStampsThatAreRounded) {
  for (const auto& [step_ns, text] :
       {std::pair{1'000'000'000, "95 % of the stamps of /camera"},
        std::pair{100'000'000,
                  "50 % of the stamps of /camera repeat the previous one: its driver "
                  "must not round them (header.stamp), and only one node"},
        std::pair{50'000'000, ""}}) {
    ConstantStamp stamps;
    for (int64_t i = 0; i < 400; ++i) stamps.Add(i * 50'000'000 / step_ns * step_ns);
    EXPECT_THAT(stamps.Finding("/camera"), StartsWith(text));
    EXPECT_EQ(stamps.Finding("/camera").empty(), step_ns == 50'000'000);
  }
}

TEST(ConstantStamp, NamesStampsThatAreZeroOrTheSame) {
  for (const auto& [t_ns, text] : {std::pair{int64_t{0}, "all stamps of /cam are zero"},
                                   std::pair{int64_t{2'500'000'000}, "are the same, 2.500 s"}}) {
    ConstantStamp stamps;
    for (int i = 0; i < 10; ++i) stamps.Add(t_ns);
    EXPECT_THAT(stamps.Finding("/cam"), IsEmpty());
    for (int i = 0; i < 10; ++i) stamps.Add(t_ns);
    EXPECT_THAT(stamps.Finding("/cam"), HasSubstr(text));
    stamps.Add(t_ns + 1);
    EXPECT_THAT(stamps.Finding("/cam"), IsEmpty());
  }
}

TEST(ConstantStamp, FaultsPass) {
  ConstantStamp stamps;
  for (int i = 0; i < 2000; ++i) stamps.Add(i / 20);
  EXPECT_NE(stamps.Finding("/cam"), "");
  for (int i = 0; i < 300; ++i) stamps.Add(1000 + i);
  EXPECT_EQ(stamps.Finding("/cam"), "");
  for (int i = 0; i < 2000; ++i) stamps.Add(5000);
  EXPECT_THAT(stamps.Finding("/cam"), HasSubstr("all stamps of /cam are the same"));
}

}  // namespace
}  // namespace plm_vins
