// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/asl_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "test/offline/recording_contents.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::MessageOf;
using testing::ReadAll;

class AslRecording : public ::testing::Test {
 protected:
  AslRecording() {
    folder_.Write("mav0/cam0/data.csv", "#timestamp [ns],filename\n10,a.png\n20,b.png\n30,c.png\n");
    folder_.Write("mav0/imu0/data.csv",
                  "#timestamp [ns],wx,wy,wz,ax,ay,az\n"
                  "5,0.1,0.2,0.3,1,2,3\n10,0,0,0,4,5,6\n15,0,0,0,7,8,9\n25,0,0,0,1,1,1\n");
    for (const char* name : {"a.png", "b.png", "c.png"}) WriteImage(name, cv::Mat(4, 6, CV_8UC1));
  }

  void WriteImage(const std::string& name, const cv::Mat& image) {
    folder_.Write("mav0/cam0/data/" + name, "");
    cv::imwrite(folder_.File("mav0/cam0/data/" + name), image);
  }

  testing::TemporaryFolder folder_;
};

// OpenCV throws at such sizes.
TEST_F(AslRecording, CountsImagesWithImpossibleHeaders) {
  folder_.Write("mav0/cam0/data/a.png", "P5 2000000 2000000 255 ");
  folder_.Write("mav0/cam0/data.csv", "10,a.png\n20," + std::string(300, 'b') + ".png\n30,c.png\n");
  const auto contents = ReadAll(OpenAslFolder(folder_.path()).get());
  EXPECT_EQ(contents.problems.at("images_unreadable"), 2);
}

TEST_F(AslRecording, MergesByTimeWithTheImuFirst) {
  const auto recording = OpenAslFolder(folder_.path());
  EXPECT_EQ(recording->end_ns(), 30);
  const auto contents = ReadAll(recording.get());
  EXPECT_EQ(contents.order, "mmimimi");
  EXPECT_THAT(contents.stamps, ElementsAre(5, 10, 10, 15, 20, 25, 30));
  EXPECT_EQ(contents.imu[0].gyro, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(contents.imu[1].accel, Eigen::Vector3d(4, 5, 6));
}

TEST_F(AslRecording, ReadsASecondCameraAndDepthIfTheyAreWanted) {
  folder_.Write("mav0/cam1/data.csv", "#timestamp [ns],filename\n10,a.png\n30,c.png\n");
  folder_.Write("mav0/depth0/data.csv", "#timestamp [ns],filename\n20,d.png\n");
  for (const char* name : {"cam1/data/a.png", "cam1/data/c.png", "depth0/data/d.png"}) {
    folder_.Write(std::string("mav0/") + name, "");
  }
  cv::imwrite(folder_.File("mav0/cam1/data/a.png"), cv::Mat(4, 6, CV_8UC1));
  cv::imwrite(folder_.File("mav0/depth0/data/d.png"), cv::Mat(4, 6, CV_16UC1, cv::Scalar(2500)));
  const auto contents =
      ReadAll(OpenAslFolder(folder_.path(), /*cameras=*/2, /*with_depth=*/true).get());
  EXPECT_EQ(contents.order, "mmiimiimxi");  // the last image of cam1 is no image
  EXPECT_THAT(contents.stamps, ElementsAre(5, 10, 10, 10, 15, 20, 20, 25, 30, 30));
  EXPECT_EQ(contents.images[2].at<uint16_t>(1, 2), 2500);
  EXPECT_EQ(ReadAll(OpenAslFolder(folder_.path()).get()).order, "mmimimi");
}

TEST_F(AslRecording, ErrorNamesAMissingSecondCamera) {
  EXPECT_THAT(MessageOf([&] { OpenAslFolder(folder_.path(), /*cameras=*/2); }),
              HasSubstr("cam1/data.csv"));
}

// Merged by time, each of these rows would delay all others.
TEST_F(AslRecording, GivesStampsInTheFutureLast) {
  const std::string hour = "3600000000000";
  folder_.Write("mav0/cam0/data.csv", "10,a.png\n" + hour + ",b.png\n20,b.png\n30,c.png\n");
  folder_.Write("mav0/imu0/data.csv", hour + ",0,0,0,4,5,6\n10,0,0,0,4,5,6\n25,0,0,0,1,1,1\n");
  const auto recording = OpenAslFolder(folder_.path());
  EXPECT_EQ(recording->end_ns(), 30);
  const auto contents = ReadAll(recording.get());
  EXPECT_THAT(contents.stamps, ElementsAre(10, 10, 20, 25, 30, 3600000000000, 3600000000000));
  EXPECT_EQ(contents.order, "miimimi");
}

TEST_F(AslRecording, SortsRowsAndReportsUnsortedOnes) {
  folder_.Write("mav0/cam0/data.csv", "20,b.png\n5000000010,c.png\n10,a.png\n5000000000,a.png\n");
  folder_.Write("mav0/imu0/data.csv",
                "25,0,0,0,3,0,0\n5,0,0,0,1,0,0\n5,0,0,0,2,0,0\n5000000005,0,0,0,4,0,0\n");
  const auto recording = OpenAslFolder(folder_.path());
  const auto contents = ReadAll(recording.get());
  EXPECT_THAT(contents.stamps, ElementsAre(5, 5, 10, 20, 25, 5000000000, 5000000005, 5000000010));
  EXPECT_EQ(contents.order, "mmiimimi");
  for (int i = 0; i < 4; ++i) EXPECT_EQ(contents.imu[i].accel.x(), i + 1);
  EXPECT_EQ(contents.problems.at("image_csv_lines_not_in_order"), 1);
  EXPECT_EQ(contents.problems.at("imu_csv_lines_not_in_order"), 1);
  EXPECT_THAT(recording->problems()[2].detail, HasSubstr("cam0/data.csv:3"));
}

TEST_F(AslRecording, AcceptsTheInnerFolder) {
  EXPECT_EQ(ReadAll(OpenAslFolder(folder_.File("mav0")).get()).order, "mmimimi");
}

TEST_F(AslRecording, ConvertsColorToGray) {
  WriteImage("a.png", cv::Mat(4, 6, CV_8UC3, cv::Scalar(10, 100, 200)));
  const auto contents = ReadAll(OpenAslFolder(folder_.path()).get());
  ASSERT_EQ(contents.images[0].type(), CV_8UC1);
  EXPECT_NEAR(contents.images[0].at<uint8_t>(0, 0), 120, 1);
}

TEST_F(AslRecording, CountsMissingAndBrokenImagesAndContinues) {
  std::filesystem::remove(folder_.File("mav0/cam0/data/a.png"));
  folder_.Write("mav0/cam0/data/c.png", "this is no image");
  const auto recording = OpenAslFolder(folder_.path());
  const auto contents = ReadAll(recording.get());
  EXPECT_EQ(contents.order, "mmxmimx");
  EXPECT_EQ(contents.problems.at("images_unreadable"), 2);
  EXPECT_THAT(recording->problems()[0].detail, HasSubstr("a.png"));
}

TEST_F(AslRecording, CountsBadCsvLinesAndContinues) {
  folder_.Write("mav0/imu0/data.csv", "5,0,0,0,0,0,9\n6,0,0\n7,0,0,zero,0,0,9\n8,nan,0,0,0,0,9\n");
  folder_.Write("mav0/cam0/data.csv", "10,a.png\nnonsense\n20,b.png\n");
  const auto contents = ReadAll(OpenAslFolder(folder_.path()).get());
  EXPECT_EQ(contents.order, "mmii");
  EXPECT_TRUE(std::isnan(contents.imu[1].gyro.x()));  // to be rejected by the sync
  EXPECT_EQ(contents.problems.at("imu_csv_lines_bad"), 2);
  EXPECT_EQ(contents.problems.at("image_csv_lines_bad"), 1);
}

TEST_F(AslRecording, NamesTheLineOfTheFirstImuSampleThatIsNotNumeric) {
  folder_.Write("mav0/imu0/data.csv", "5,0,0,0,0,0,9\n7,0,0,zero,0,0,9\n8,0,0\n");
  const auto recording = OpenAslFolder(folder_.path());
  ReadAll(recording.get());
  EXPECT_THAT(recording->problems()[3].detail, HasSubstr("imu0/data.csv:2"));
}

TEST_F(AslRecording, ErrorNamesAMissingPart) {
  std::filesystem::remove(folder_.File("mav0/imu0/data.csv"));
  EXPECT_THAT(MessageOf([&] { OpenAslFolder(folder_.path()); }), HasSubstr("imu0/data.csv"));
  EXPECT_THAT(MessageOf([&] { OpenAslFolder(folder_.File("nothing")); }), HasSubstr("nothing"));
}

TEST_F(AslRecording, RejectsAFolderWithoutImages) {
  folder_.Write("mav0/cam0/data.csv", "#timestamp [ns],filename\n");
  EXPECT_THAT(MessageOf([&] { OpenAslFolder(folder_.path()); }), HasSubstr("no image"));
}

TEST_F(AslRecording, ErrorNamesTheFirstLineOfAnUnusableFile) {
  folder_.Write("mav0/imu0/data.csv", "#t,gyro,accel\n1.5,0,0,0,0,0,9\n1.6,0,0,0,0,0,9\n");
  EXPECT_THAT(MessageOf([&] { OpenAslFolder(folder_.path()); }),
              ::testing::AllOf(HasSubstr("\"stamp [ns],gyro"), HasSubstr("imu0/data.csv:2")));
}

TEST_F(AslRecording, RejectsAFolderWithoutImuSamples) {
  folder_.Write("mav0/imu0/data.csv", "#timestamp [ns],wx,wy,wz,ax,ay,az\n");
  EXPECT_THAT(MessageOf([&] { OpenAslFolder(folder_.path()); }), HasSubstr("no IMU sample"));
}

}  // namespace
}  // namespace plm_vins
