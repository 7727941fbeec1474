// SPDX-License-Identifier: BSD-3-Clause
#include "common/features/feature_ids.h"

#include <gtest/gtest.h>

#include <limits>

namespace plm_vins {
namespace {

TEST(FeatureIds, AreRestoredAcrossWraps) {
  IdRestorer restorer;
  for (int64_t newest = 0; newest < 5 * kTransportableIds; newest += 100'003) {
    for (const int64_t id : {newest, newest - 90'000, newest - 12}) {
      if (id >= 0) {
        ASSERT_EQ(restorer.Restore(WrapId(id)), id);
      }
    }
  }
}

TEST(FeatureIds, TravelAsFloats) {
  for (const int64_t id : {int64_t{16'777'215}, int64_t{16'777'217}, int64_t{123'456'789'012}}) {
    EXPECT_EQ(ReadId(static_cast<float>(WrapId(id))), WrapId(id));
  }
}

TEST(FeatureIds, RejectsInvalidIds) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float value : {-1.0F, 0.5F, 16'777'216.0F, 1e30F, infinity, infinity - infinity}) {
    EXPECT_THROW(ReadId(value), std::invalid_argument) << value;
  }
}

TEST(FeatureIds, AreNewAfterATrackerRestart) {
  IdRestorer restorer;
  for (const int64_t id : {0, 1, 700, 3}) EXPECT_EQ(restorer.Restore(id), id);
  restorer.BeginTracker();
  EXPECT_EQ(restorer.Restore(3), 704);
  EXPECT_EQ(restorer.Restore(0), 701);
  restorer.BeginTracker();
  EXPECT_EQ(restorer.Restore(0), 705);
}

// The ids of another tracker may start anywhere.
TEST(FeatureIds, MayBeginAnywhere) {
  IdRestorer restorer;
  EXPECT_EQ(restorer.Restore(kTransportableIds - 1), kTransportableIds - 1);
  EXPECT_EQ(restorer.Restore(0), kTransportableIds);
  EXPECT_EQ(restorer.Restore(kTransportableIds - 1), kTransportableIds - 1);
}

}  // namespace
}  // namespace plm_vins
