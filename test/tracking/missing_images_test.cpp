// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/missing_images.h"

#include <gtest/gtest.h>

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr int64_t kInterval_ns = 50'000'000;  // of camera 0

int64_t Stamp(int image) { return 1'000'000'000 + image * kInterval_ns; }

bool Contains(const DropCount& count, const std::string& words) {
  return count.detail.find(words) != std::string::npos;
}

TEST(MissingImages, NoneHasCome) {
  MissingImages missing("images_without_camera1");
  missing.AddMissing(Stamp(0), std::nullopt);
  EXPECT_EQ(missing.count().cause, "images_without_camera1");
  EXPECT_EQ(missing.count().count, 1);
  EXPECT_TRUE(Contains(missing.count(), "none has come yet"));
}

TEST(MissingImages, OfLowerRate) {
  MissingImages missing("images_without_depth");
  for (int image = 0; image < 100; ++image) {
    if (image % 3 == 0) {
      missing.AddPaired(Stamp(image));
    } else {
      missing.AddMissing(Stamp(image), Stamp(image - image % 3));
    }
  }
  EXPECT_TRUE(Contains(missing.count(), "6.7 come per second, and 20.0 of camera 0"))
      << missing.count().detail;
}

TEST(MissingImages, AtTheTimesInBetween) {
  MissingImages missing("images_without_camera1");
  for (int image = 0; image < 50; ++image) {
    missing.AddMissing(Stamp(image), Stamp(image) - kInterval_ns / 2);
  }
  EXPECT_TRUE(Contains(missing.count(), "a constant 25.0 ms earlier")) << missing.count().detail;
  EXPECT_TRUE(Contains(missing.count(), "triggered in turn")) << missing.count().detail;
}

// Every other one is unusable, which is neither a lower rate nor an offset.
TEST(MissingImages, UnusableOnesAreTheCause) {
  MissingImages missing("images_without_camera1");
  for (int image = 0; image < 100; ++image) {
    if (image % 2 == 0) {
      missing.AddUnusable(Stamp(image), "image is too small");
      missing.AddMissing(Stamp(image), image == 0 ? std::nullopt : std::optional(Stamp(image - 1)));
    } else {
      missing.AddPaired(Stamp(image));
    }
  }
  EXPECT_EQ(missing.count().detail, "image is too small");
}

// A camera that stopped is none of these.
TEST(MissingImages, TheFirstOneAfterAStop) {
  MissingImages missing("images_without_camera1");
  missing.AddPaired(Stamp(0));
  for (int image = 1; image < 50; ++image) missing.AddMissing(Stamp(image), Stamp(0));
  EXPECT_EQ(missing.count().detail, "the last one's timestamp is 50.0 ms earlier");
}

}  // namespace
}  // namespace plm_vins
