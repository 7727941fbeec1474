// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/output/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "pose_graph/output/map_archive.h"
#include "test/pose_graph/two_visits.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

class MapFileTest : public ::testing::Test {
 protected:
  MapFileTest() {
    const auto camera = testing::SimpleCamera();
    for (int i = 0; i < 3; ++i) {
      map_.keyframes.push_back(testing::Visit(testing::Wall(), *camera, Rigid3d(), i, {}));
      map_.graph.AddNode({0.1 * i, {1.0 * i, 2, 3}});
    }
    map_.keyframes[1].covariance = 0.1 * Matrix4d::Identity();
    map_.keyframes[1].R_O_Manhattan = Eigen::Quaterniond(0.6, 0, 0, 0.8);
    map_.keyframes[2].corners[0].p_O.reset();
    map_.graph.AddEdge({0, 1, {0.1, {1, 0, 0}}, 2 * Matrix4d::Identity(), false});
    map_.graph.AddEdge({0, 2, {0.2, {2, 0, 0}}, 3 * Matrix4d::Identity(), true});
  }

  std::string ErrorOfLoading() const {
    try {
      LoadMap(file_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }

  void Write(const std::string& bytes) const { folder_.Write("map.plm", bytes); }

  testing::TemporaryFolder folder_;
  std::string file_ = folder_.File("map.plm");
  KeyframeMap map_;
};

TEST_F(MapFileTest, ComesBackAsItWas) {
  SaveMap(file_, map_);
  const KeyframeMap loaded = LoadMap(file_);
  ASSERT_EQ(loaded.keyframes.size(), 3u);
  EXPECT_EQ(loaded.graph.node(2).translation, map_.graph.node(2).translation);
  EXPECT_TRUE(loaded.graph.edges()[1].is_loop);
  EXPECT_EQ(loaded.graph.edges()[1].covariance, map_.graph.edges()[1].covariance);
  EXPECT_EQ(loaded.keyframes[1].R_O_Manhattan->coeffs(), map_.keyframes[1].R_O_Manhattan->coeffs());
  EXPECT_FALSE(loaded.keyframes[2].corners[0].p_O);
  EXPECT_EQ(loaded.keyframes[0].corners[5].descriptor, map_.keyframes[0].corners[5].descriptor);
  EXPECT_EQ(loaded.keyframes[0].segments.size(), map_.keyframes[0].segments.size());

  // What is saved again has the same bytes, so nothing was lost.
  const std::string first = folder_.Read("map.plm");
  SaveMap(file_, loaded);
  EXPECT_EQ(folder_.Read("map.plm"), first);
}

TEST_F(MapFileTest, OfAPreviousRunIsEmptyWhereThereIsNoneAndSaysSo) {
  const PreviousMap none = LoadPreviousMap(folder_.File("no/such/folder/map.plm"));
  EXPECT_TRUE(none.map.keyframes.empty());
  EXPECT_THAT(none.warning, HasSubstr("load_previous_pose_graph: there is no map " +
                                      folder_.File("no/such/folder/map.plm")));
  SaveMap(file_, map_);
  const PreviousMap previous = LoadPreviousMap(file_);
  EXPECT_EQ(previous.map.keyframes.size(), 3u);
  EXPECT_EQ(previous.warning, "");
  Write("damaged");
  EXPECT_THROW(LoadPreviousMap(file_), std::runtime_error);
}

TEST_F(MapFileTest, TakesAboutFifteenKilobytesForAKeyframe) {
  map_.keyframes[0].corners.resize(300);
  SaveMap(file_, map_);
  EXPECT_LT(std::filesystem::file_size(file_), 3u * 20'000);
}

TEST_F(MapFileTest, LeavesNoUnfinishedFile) {
  SaveMap(file_, map_);
  EXPECT_FALSE(std::filesystem::exists(file_ + ".part"));
}

TEST_F(MapFileTest, SaysWhereTheFileCannotBeWritten) {
  const std::string nowhere = folder_.File("no/such/folder/map.plm");
  try {
    SaveMap(nowhere, map_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(nowhere));
  }
}

TEST_F(MapFileTest, SaysThatThereIsNone) {
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("map.plm: there is no such map"));
}

TEST_F(MapFileTest, KnowsWhatIsNoMap) {
  Write("some other file, and a long one");
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("is no map of plm_vins"));
  Write("");
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("is no map of plm_vins"));
}

TEST_F(MapFileTest, RefusesAnotherVersion) {
  SaveMap(file_, map_);
  std::string bytes = folder_.Read("map.plm");
  bytes[sizeof("plm_vins map")] = 9;
  Write(bytes);
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("is a map of version 9, this program reads version 2"));
}

TEST_F(MapFileTest, FindsEveryDamage) {
  SaveMap(file_, map_);
  const std::string bytes = folder_.Read("map.plm");
  for (const size_t place : {bytes.size() - 1, bytes.size() / 2, size_t{40}, size_t{20}}) {
    std::string damaged = bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 4);
    Write(damaged);
    EXPECT_THAT(ErrorOfLoading(), HasSubstr("is damaged")) << place;
  }
  for (const size_t size : {bytes.size() - 1, bytes.size() / 2, size_t{15}}) {
    Write(bytes.substr(0, size));
    EXPECT_THAT(ErrorOfLoading(), HasSubstr("is damaged")) << size;
  }
}

// As of damage that the checksum does not show.
TEST(MapReaderTest, TakesNothingButOneForTrueAndZeroForFalse) {
  const std::string_view bytes("\1\0\2\2", 4);
  bool value = false;
  MapReader reader(bytes);
  reader.Value(value);
  EXPECT_TRUE(value);
  reader.Value(value);
  EXPECT_FALSE(value);
  EXPECT_THROW(reader.Value(value), std::runtime_error);
  std::optional<double> number;
  EXPECT_THROW(reader.Has(number), std::runtime_error);
}

}  // namespace
}  // namespace plm_vins
