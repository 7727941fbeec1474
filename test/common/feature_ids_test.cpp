// SPDX-License-Identifier: BSD-3-Clause
#include "common/feature_ids.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(FeatureIds, ComeBackAcrossManyWraps) {
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
    EXPECT_EQ(static_cast<int64_t>(static_cast<float>(WrapId(id))), WrapId(id));
  }
}

TEST(FeatureIds, OfATrackerThatStartsAgainAreNew) {
  IdRestorer restorer;
  for (const int64_t id : {0, 1, 700, 3}) EXPECT_EQ(restorer.Restore(id), id);
  restorer.BeginTracker();
  EXPECT_EQ(restorer.Restore(3), 704);
  EXPECT_EQ(restorer.Restore(0), 701);
  restorer.BeginTracker();
  EXPECT_EQ(restorer.Restore(0), 705);
}

// A tracker of another package may begin with any id.
TEST(FeatureIds, MayBeginAnywhere) {
  IdRestorer restorer;
  EXPECT_EQ(restorer.Restore(kTransportableIds - 1), kTransportableIds - 1);
  EXPECT_EQ(restorer.Restore(0), kTransportableIds);
  EXPECT_EQ(restorer.Restore(kTransportableIds - 1), kTransportableIds - 1);
}

}  // namespace
}  // namespace plm_vins
