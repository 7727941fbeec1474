// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/asl_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "simulator/recording/ground_truth.h"
#include "test/testing/message_of.h"

namespace plm_vins::simulator {
namespace {

std::string Read(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class AslFolder : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  const std::string folder_ = ::testing::TempDir() + "plm_vins_asl_recorder_test";
};

TEST_F(AslFolder, HoldsImagesAndListsAsEuroc) {
  const cv::Mat1b picture(6, 8, uchar(77));
  {
    AslRecorder recorder(folder_);
    recorder.Write(ImuSample{1'600'000'000'000'000'005, {0.1, 0.2, 0.3}, {1, 2, 9.8125}});
    recorder.WriteImage(0, ImageSample{1'600'000'000'050'000'000, picture});
    recorder.Finish();
  }
  EXPECT_NE(
      Read(folder_ + "/mav0/imu0/data.csv").find("\n1600000000000000005,0.1,0.2,0.3,1,2,9.8125\n"),
      std::string::npos);
  EXPECT_NE(
      Read(folder_ + "/mav0/cam0/data.csv").find("\n1600000000050000000,1600000000050000000.png\n"),
      std::string::npos);
  const cv::Mat read = cv::imread(folder_ + "/mav0/cam0/data/1600000000050000000.png", 0);
  ASSERT_EQ(read.size(), picture.size());
  EXPECT_EQ(cv::countNonZero(read != picture), 0);
}

TEST_F(AslFolder, HoldsTheSecondCameraAndDepth) {
  const cv::Mat1b picture(6, 8, uchar(77));
  const cv::Mat1w depth(6, 8, ushort(5432));
  {
    AslRecorder recorder(folder_);
    recorder.WriteImage(1, ImageSample{1'600'000'000'050'000'000, picture});
    recorder.WriteDepth(1'600'000'000'050'000'000, depth);
    recorder.Finish();
  }
  for (const std::string name : {"cam1", "depth0"}) {
    EXPECT_NE(Read(folder_ + "/mav0/" + name + "/data.csv")
                  .find("\n1600000000050000000,1600000000050000000.png\n"),
              std::string::npos);
  }
  const auto pixel = [&](const std::string& name) {
    const std::string file = folder_ + "/mav0/" + name + "/data/1600000000050000000.png";
    const cv::Mat read = cv::imread(file, cv::IMREAD_UNCHANGED);
    return read.type() == CV_16UC1 ? read.at<ushort>(5, 7) : read.at<uchar>(5, 7);
  };
  EXPECT_EQ(pixel("cam1"), 77);
  EXPECT_EQ(pixel("depth0"), 5432);
}

TEST_F(AslFolder, IsNeverOverwritten) {
  { AslRecorder first(folder_); }
  EXPECT_THROW(AslRecorder second(folder_), std::runtime_error);
}

TEST(GroundTruth, NoticesAFullDisk) {
  EXPECT_THROW(WriteTum("/dev/full", {FrameState()}), std::runtime_error);
  EXPECT_THROW(WriteEurocCsv("/dev/full", {FrameState()}), std::runtime_error);
}

TEST_F(AslFolder, TakesTheGroundTruth) {
  AslRecorder recorder(folder_);
  FrameState state;
  state.t_ns = 1'600'000'000'000'000'005;
  state.SetPose({Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1, 2, 3}});
  state.velocity() = Eigen::Vector3d(4, 5, 6);
  state.SetBias({{10, 11, 12}, {7, 8, 9}});
  const std::string csv = AslRecorder::GroundTruthFile(folder_);
  WriteEurocCsv(csv, {state});
  EXPECT_NE(Read(csv).find("\n1600000000000000005,1,2,3,0.5,0.5,-0.5,0.5,4,5,6,7,8,9,10,11,12\n"),
            std::string::npos);
  WriteTum(folder_ + "/truth.tum", {state});
  std::istringstream row(Read(folder_ + "/truth.tum"));
  std::string stamp;
  double x, y, z, qx, qy, qz, qw;
  row >> stamp >> x >> y >> z >> qx >> qy >> qz >> qw;
  EXPECT_EQ(stamp, "1600000000.000000005");
  EXPECT_EQ(z, 3);
  EXPECT_EQ(qy, -0.5);
  EXPECT_EQ(qw, 0.5);
}

TEST(GroundTruth, ErrorNamesTheFile) {
  EXPECT_THAT(testing::MessageOf([] { WriteTum("/nowhere/truth.tum", {}); }),
              ::testing::HasSubstr("/nowhere/truth.tum"));
}

}  // namespace
}  // namespace plm_vins::simulator
