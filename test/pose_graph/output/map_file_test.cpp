// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/output/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "test/pose_graph/two_visits.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class MapFileTest : public ::testing::Test {
 protected:
  MapFileTest() {
    const auto camera = testing::SimpleCamera();
    for (int i = 0; i < 3; ++i) {
      map_.keyframes.push_back(testing::Visit(testing::Wall(), *camera, Rigid3d(), i, {}));
      map_.graph.AddNode({0.1 * i, {1.0 * i, 2, 3}});
    }
    map_.keyframes[1].covariance = 0.1 * Matrix4d::Identity();
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

TEST_F(MapFileTest, SurvivesARoundTrip) {
  SaveMap(file_, map_);
  const KeyframeMap loaded = LoadMap(file_);
  ASSERT_EQ(loaded.keyframes.size(), 3u);
  EXPECT_EQ(loaded.graph.node(2).translation, map_.graph.node(2).translation);
  EXPECT_TRUE(loaded.graph.edges()[1].is_loop);
  EXPECT_EQ(loaded.graph.edges()[1].covariance, map_.graph.edges()[1].covariance);
  EXPECT_FALSE(loaded.keyframes[2].corners[0].p_O);
  EXPECT_EQ(loaded.keyframes[0].corners[5].descriptor, map_.keyframes[0].corners[5].descriptor);
  EXPECT_EQ(loaded.keyframes[0].segments.size(), map_.keyframes[0].segments.size());

  // Saving the map again gives the same bytes, so no information was lost.
  const std::string first = folder_.Read("map.plm");
  SaveMap(file_, loaded);
  EXPECT_EQ(folder_.Read("map.plm"), first);
}

TEST_F(MapFileTest, MissingPreviousMapIsEmptyWithAWarning) {
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

// Half of the corners are landmarks, and some lines are in view.
TEST_F(MapFileTest, TakesAboutTwentyKilobytesForAKeyframe) {
  KeyframeMap map;
  map.graph.AddNode({});
  Keyframe& keyframe = map.keyframes.emplace_back();
  keyframe.corners.resize(300);
  for (int i = 0; i < 150; ++i) keyframe.corners[i].p_O = Eigen::Vector3f::Zero();
  keyframe.segments.resize(20);
  SaveMap(file_, map);
  EXPECT_NEAR(static_cast<double>(std::filesystem::file_size(file_)), 20'000, 2'000);
}

TEST_F(MapFileTest, LeavesNoUnfinishedFile) {
  SaveMap(file_, map_);
  EXPECT_FALSE(std::filesystem::exists(file_ + ".part"));
}

TEST_F(MapFileTest, ErrorNamesAnUnwritableFile) {
  const std::string nowhere = folder_.File("no/such/folder/map.plm");
  try {
    SaveMap(nowhere, map_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(nowhere));
  }
}

TEST_F(MapFileTest, ErrorNamesAMissingFile) {
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("map.plm: no such file; check the path of the map"));
}

TEST_F(MapFileTest, DistinguishesUnreadableFromMissing) {
  std::filesystem::create_symlink(file_, file_);
  EXPECT_THAT(ErrorOfLoading(),
              AllOf(HasSubstr("map.plm cannot be read: "), Not(HasSubstr("no such file"))));
}

TEST_F(MapFileTest, RejectsOtherFiles) {
  Write("some other file, and a long one");
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("is not a map of plm_vins"));
  Write("");
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("is not a map of plm_vins"));
}

TEST_F(MapFileTest, ErrorNamesAFolder) {
  std::filesystem::create_directory(file_);
  EXPECT_THAT(ErrorOfLoading(), HasSubstr("map.plm is a folder; name the map file in it"));
}

TEST_F(MapFileTest, RejectsAnotherVersion) {
  SaveMap(file_, map_);
  std::string bytes = folder_.Read("map.plm");
  bytes[sizeof("plm_vins map")] = 9;
  Write(bytes);
  EXPECT_THAT(ErrorOfLoading(),
              AllOf(HasSubstr("is a map of version 9, this program reads version 4"),
                    HasSubstr("; record a new map")));
}

TEST_F(MapFileTest, DetectsEveryDamagedByte) {
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

}  // namespace
}  // namespace plm_vins
