// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "pose_graph/output/colmap_writer.h"
#include "pose_graph/output/g2o_writer.h"
#include "pose_graph/output/loop_table.h"
#include "test/pose_graph/two_visits.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Two keyframes a meter apart, in a map that is rotated by a quarter turn.
KeyframeMap SmallMap(const CameraModel& camera) {
  KeyframeMap map;
  const LevelTransform T_M_O = {M_PI / 2, {0, 0, 1}};
  testing::VisitOptions options;
  options.noise = 0;
  for (int i = 0; i < 2; ++i) {
    const Rigid3d T_O_B(Eigen::Quaterniond::Identity(), {0, 1.0 * i, 0});
    map.keyframes.push_back(testing::Visit(testing::Wall(), camera, T_O_B, 7 + i, options));
    map.graph.AddNode(T_M_O * map.keyframes.back().T_O_L());
  }
  map.graph.AddEdge({0, 1, {0, {0, 1, 0}}, 0.25 * Matrix4d::Identity(), false});
  return map;
}

std::vector<std::string> Words(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

TEST(WriteG2o, HasNodesAndEdgesWithInformation) {
  std::ostringstream text;
  WriteG2o(SmallMap(*testing::SimpleCamera()), &text);
  std::istringstream lines(text.str());
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, StartsWith("VERTEX_SE3:QUAT 0 0 0 1 0 0 0.707"));
  std::getline(lines, line);
  EXPECT_THAT(line, StartsWith("VERTEX_SE3:QUAT 1 -1 "));
  std::getline(lines, line);
  const auto words = Words(line);
  ASSERT_EQ(words.size(), 3u + 7 + 21);
  EXPECT_EQ(words[0], "EDGE_SE3:QUAT");
  EXPECT_EQ(words[10], "4");   // 1 / variance of x
  EXPECT_EQ(words[30], "16");  // of half the yaw
  EXPECT_FALSE(std::getline(lines, line));
}

// A loop between worlds with different headings. It is certain along x of `from`, which is -y of
// `to`.
TEST(WriteG2o, HasInformationInTheAxesOfTheLaterNode) {
  KeyframeMap map = SmallMap(*testing::SimpleCamera());
  LevelEdge loop = {0, 1, {M_PI / 2, {0, 1, 0}}, Matrix4d::Identity(), true};
  loop.covariance(0, 0) = 0.01;
  map.graph.AddEdge(loop);
  std::ostringstream text;
  WriteG2o(map, &text);
  const auto words = Words(text.str().substr(text.str().rfind("EDGE_SE3:QUAT")));
  ASSERT_EQ(words.size(), 3u + 7 + 21);
  EXPECT_NEAR(std::stod(words[10]), 1, 1e-6);    // along x
  EXPECT_NEAR(std::stod(words[16]), 100, 1e-6);  // along y
}

class ColmapTest : public ::testing::Test {
 protected:
  ColmapTest() : camera_(testing::SimpleCamera()), map_(SmallMap(*camera_)) {
    WriteColmapModel(folder_.File("model"), camera_->parameters(), map_);
  }

  // Expects that the first corner of the first image is the projection of its point.
  void ExpectConsistent(const CameraModel& camera) const {
    std::istringstream images(folder_.Read("model/images.txt"));
    std::string pose, corners;
    std::getline(images, pose);
    std::getline(images, corners);
    const auto words = Words(pose);
    ASSERT_EQ(words.size(), 10u);
    EXPECT_EQ(words[9], "7.png");
    const auto number = [&](int i) { return std::stod(words[i]); };
    const Rigid3d T_C_M(Eigen::Quaterniond(number(1), number(2), number(3), number(4)),
                        {number(5), number(6), number(7)});
    double u, v;
    int64_t id;
    std::istringstream(corners) >> u >> v >> id;

    std::istringstream points(folder_.Read("model/points3D.txt"));
    std::string line;
    while (std::getline(points, line) && Words(line)[0] != std::to_string(id)) continue;
    const auto point = Words(line);
    const Eigen::Vector3d p_M(std::stod(point[1]), std::stod(point[2]), std::stod(point[3]));
    const auto uv_px = camera.Project(T_C_M * p_M);
    ASSERT_TRUE(uv_px);
    EXPECT_NEAR(uv_px->x() + 0.5, u, 0.05);
    EXPECT_NEAR(uv_px->y() + 0.5, v, 0.05);
    EXPECT_EQ(point[8], "1");  // seen in the first image
  }

  testing::TemporaryFolder folder_;
  std::shared_ptr<const CameraModel> camera_;
  KeyframeMap map_;
};

TEST_F(ColmapTest, HasTheCamera) {
  EXPECT_EQ(folder_.Read("model/cameras.txt"), "1 OPENCV 752 480 460 460 376.5 240.5 0 0 0 0\n");
}

TEST_F(ColmapTest, ProjectsItsPointsToItsCorners) { ExpectConsistent(*camera_); }

// As of a map that was loaded: the model has one camera for all.
TEST_F(ColmapTest, ConvertsKeyframesOfAnotherCameraToItsPixels) {
  const auto other = testing::SimpleCamera(300);
  WriteColmapModel(folder_.File("model"), other->parameters(), map_);
  ExpectConsistent(*other);
}

TEST_F(ColmapTest, HasOneNameForEachImage) {
  map_.keyframes[1].t_ns = map_.keyframes[0].t_ns;
  WriteColmapModel(folder_.File("model"), camera_->parameters(), map_);
  EXPECT_THAT(folder_.Read("model/images.txt"), AllOf(HasSubstr(" 7.png"), HasSubstr(" 7_2.png")));
}

// Its frame is another one.
TEST_F(ColmapTest, OmitsUnconnectedWorlds) {
  const std::string points = folder_.Read("model/points3D.txt");
  testing::VisitOptions options;
  options.world = 1;
  map_.keyframes.push_back(testing::Visit(testing::Wall(), *camera_, Rigid3d(), 9, options));
  map_.graph.AddNode({});
  WriteColmapModel(folder_.File("model"), camera_->parameters(), map_);
  EXPECT_THAT(folder_.Read("model/images.txt"), AllOf(HasSubstr(" 8.png"), Not(HasSubstr(" 9."))));
  EXPECT_EQ(folder_.Read("model/points3D.txt"), points);
}

TEST_F(ColmapTest, ErrorNamesAnUnwritableFolder) {
  folder_.Write("file", "");
  EXPECT_THROW(WriteColmapModel(folder_.File("file/model"), camera_->parameters(), map_),
               std::runtime_error);
}

TEST(LoopTable, HasAValueOrAnEmptyFieldInEachColumn) {
  std::ostringstream text;
  WriteLoopHeader(&text);
  LoopCandidate candidate;
  candidate.failed = LoopGate::kManhattan;
  candidate.matches = 40;
  candidate.manhattan_error = 0.1;
  WriteLoopRow(candidate, &text);
  candidate.failed.reset();
  WriteLoopRow(candidate, &text);
  std::istringstream lines(text.str());
  std::string header, refused, accepted;
  std::getline(lines, header);
  std::getline(lines, refused);
  std::getline(lines, accepted);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','),
            std::count(refused.begin(), refused.end(), ','));
  EXPECT_THAT(refused, HasSubstr(",manhattan,"));
  EXPECT_THAT(refused, HasSubstr(",40,,,,5.7296,,"));
  EXPECT_THAT(accepted, HasSubstr(",accepted,"));
}

}  // namespace
}  // namespace plm_vins
