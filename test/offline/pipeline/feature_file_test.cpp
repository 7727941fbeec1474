// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/feature_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "test/testing/message_of.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

constexpr int64_t kStart = 1403636579763555584;

TrackedItem ImuItem() {
  TrackedItem item;
  item.imu = {kStart - 5, {0.1, -0.2, 0.3}, {9.7, 1e-9, -0.4}};
  return item;
}

TrackedItem FrameItem() {
  TrackedItem item;
  item.frame = std::make_unique<TrackedFeatures>();
  TrackedPoints& points = item.frame->points;
  points.features.t_ns = kStart;
  points.features.points.push_back({7, {0.1, 0.2}, {300.25, 200.5}, {-1, 2}});
  points.features.points.push_back({9, {1 / 3.0, -0.2}, {0, 0}, {0, 0}});
  points.statistics.epipolar_outliers = 3;
  points.publish = false;
  TrackedLines& lines = item.frame->lines.emplace();
  lines.features.t_ns = kStart;
  lines.features.lines = {{4, {0.1, 0.1}, {-0.3, 0.7}}};
  lines.statistics.added = 2;
  lines.restart = true;
  return item;
}

const Json kValues = {{"freq", 10.0}, {"corner_detector", "harris"}, {"use_lines", true}};
constexpr size_t kItemsBegin = 16 + 4 + 57;  // after signature, size of the values, values

class FeatureFile : public ::testing::Test {
 protected:
  void Write() {
    FeatureFileWriter writer(file_, kValues);
    writer.Add(ImuItem());
    writer.Add(FrameItem());
    writer.Close();
  }

  testing::TemporaryFolder folder_;
  const std::string file_ = folder_.path() + "/flight.features";
};

std::string ErrorOf(const std::string& file) {
  return testing::MessageOf([&] {
    FeatureFileReader reader(file);
    while (reader.Next()) {
    }
  });
}

TEST_F(FeatureFile, SurvivesARoundTrip) {
  Write();
  FeatureFileReader reader(file_);
  EXPECT_EQ(reader.tracker_values(), kValues);
  const auto imu = reader.Next();
  ASSERT_TRUE(imu && !imu->frame);
  EXPECT_EQ(imu->t_ns(), kStart - 5);
  EXPECT_EQ(imu->imu.gyro, ImuItem().imu.gyro);
  EXPECT_EQ(imu->imu.accel, ImuItem().imu.accel);

  const auto item = reader.Next();
  ASSERT_TRUE(item && item->frame && item->frame->lines);
  EXPECT_EQ(item->t_ns(), kStart);
  const TrackedPoints& points = item->frame->points;
  ASSERT_EQ(points.features.points.size(), 2u);
  EXPECT_EQ(points.features.points[0].id, 7);
  EXPECT_EQ(points.features.points[0].uv_px, Eigen::Vector2d(300.25, 200.5));
  EXPECT_EQ(points.features.points[0].velocity, Eigen::Vector2d(-1, 2));
  EXPECT_EQ(points.features.points[1].xy, Eigen::Vector2d(1 / 3.0, -0.2));
  EXPECT_EQ(points.statistics.epipolar_outliers, 3);
  EXPECT_FALSE(points.publish);
  const TrackedLines& lines = *item->frame->lines;
  ASSERT_EQ(lines.features.lines.size(), 1u);
  EXPECT_EQ(lines.features.lines[0].id, 4);
  EXPECT_EQ(lines.features.lines[0].end, Eigen::Vector2d(-0.3, 0.7));
  EXPECT_EQ(lines.statistics.added, 2);
  EXPECT_TRUE(lines.restart);
  EXPECT_FALSE(reader.Next());
}

TEST_F(FeatureFile, CamerasAndDepthSurviveARoundTrip) {
  TrackedItem written = FrameItem();
  auto& points = written.frame->points.features.points;
  points[1].depth = 2.5;
  points.push_back({points[0].id, {0.05, 0.21}, {1, 2}, {0, 0}, 1});
  auto& lines = written.frame->lines->features.lines;
  lines.push_back({lines[0].id, {0.05, 0.1}, {-0.35, 0.7}, 2, {1e-3, 2e-3}});
  FeatureFileWriter writer(file_, kValues);
  writer.Add(written);
  writer.Close();
  FeatureFileReader reader(file_);
  const auto item = reader.Next();
  ASSERT_TRUE(item && item->frame && item->frame->lines);
  const auto& read = item->frame->points.features.points;
  ASSERT_EQ(read.size(), 3u);
  EXPECT_FALSE(read[0].depth);
  EXPECT_EQ(read[1].depth, 2.5);
  EXPECT_EQ(read[2].camera, 1);
  EXPECT_EQ(read[2].xy, points[2].xy);
  const LineObservation& line = item->frame->lines->features.lines.back();
  EXPECT_EQ(line.camera, 2);
  EXPECT_EQ(line.end, Eigen::Vector2d(-0.35, 0.7));
  EXPECT_EQ(line.deviation, Eigen::Vector2d(1e-3, 2e-3));
  EXPECT_FALSE(reader.Next());
}

TEST_F(FeatureFile, ErrorNamesTheFile) {
  EXPECT_NE(ErrorOf(file_).find(file_ + ": cannot be read"), std::string::npos);
  std::ofstream(file_) << "a text that is longer than the signature of such a file";
  EXPECT_NE(ErrorOf(file_).find(file_ + ": is not a feature file"), std::string::npos);
  EXPECT_THROW(FeatureFileWriter(folder_.path() + "/missing/file", kValues), std::runtime_error);
}

TEST_F(FeatureFile, ReportsAnotherVersion) {
  std::ofstream(file_) << "plm_features v1\n" << std::string(100, '\1');
  EXPECT_EQ(ErrorOf(file_),
            file_ +
                ": was written by another version of this program; record it again with "
                "--save-features");
}

TEST_F(FeatureFile, ReportsDamagedOrTruncatedValues) {
  Write();
  std::string bytes = folder_.Read("flight.features");
  ASSERT_EQ(bytes.substr(kItemsBegin - 1, 2), "}\1");
  std::ofstream(file_) << bytes.substr(0, kItemsBegin - 1);
  EXPECT_NE(ErrorOf(file_).find(file_ + ": ends too early"), std::string::npos);
  bytes[kItemsBegin - 1] = ']';
  std::ofstream(file_) << bytes;
  EXPECT_NE(ErrorOf(file_).find(file_ + ": is damaged"), std::string::npos);
}

// The nesting exceeds the stack.
TEST_F(FeatureFile, RejectsNestedValues) {
  constexpr uint32_t kDepth = 300'000;
  for (const std::string& text :
       {R"({"freq":)" + std::string(kDepth, '[') + std::string(kDepth, ']') + "}",
        std::string(R"({"camera":{"names":{"freq":10}}})")}) {
    const auto size = static_cast<uint32_t>(text.size());
    std::ofstream(file_, std::ios::binary)
        << "plm_features v3\n"
        << std::string(reinterpret_cast<const char*>(&size), sizeof(size)) << text;
    EXPECT_NE(ErrorOf(file_).find(file_ + ": is damaged"), std::string::npos);
  }
}

TEST_F(FeatureFile, AcceptsListsOfNumbersAsValues) {
  const Json values = {{"freq", 10.0}, {"coefficients", {0.1, 0.2}}};
  FeatureFileWriter(file_, values).Close();
  EXPECT_EQ(FeatureFileReader(file_).tracker_values(), values);
}

TEST_F(FeatureFile, ReportsATruncatedOrDamagedFile) {
  Write();
  const auto size = std::filesystem::file_size(file_);
  std::filesystem::resize_file(file_, size - 9);
  EXPECT_NE(ErrorOf(file_).find(file_ + ": ends too early"), std::string::npos);
  Write();
  {
    std::fstream file(file_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(kItemsBegin);
    file.put('\x77');  // no valid kind of item
  }
  EXPECT_NE(ErrorOf(file_).find(file_ + ": is damaged"), std::string::npos);
}

// A power failure while writing can leave zeros at the end of a file.
TEST_F(FeatureFile, RejectsAFileOfZeros) {
  Write();
  std::ofstream(file_, std::ios::app | std::ios::binary) << std::string(46, '\0');
  EXPECT_NE(ErrorOf(file_).find(file_ + ": is damaged"), std::string::npos);
}

TEST_F(FeatureFile, RejectsImpossibleFeatures) {
  TrackedItem with_a_point = FrameItem();
  with_a_point.frame->points.features.points[1].id = 7;  // duplicate id
  TrackedItem with_a_line = FrameItem();
  with_a_line.frame->lines->features.lines[0].end.x() = std::nan("");
  for (const TrackedItem* item : {&with_a_point, &with_a_line}) {
    FeatureFileWriter writer(file_, kValues);
    writer.Add(*item);
    writer.Close();
    EXPECT_NE(ErrorOf(file_).find(file_ + ": is damaged"), std::string::npos);
  }
}

TEST_F(FeatureFile, WithstandsDamageOfEveryByte) {
  Write();
  const std::string bytes = folder_.Read("flight.features");
  int refused = 0;
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (const char damage : {'\x00', '\x02', '\x7f', '\xff'}) {
      std::string damaged = bytes;
      damaged[i] = damage;
      std::ofstream(file_, std::ios::binary) << damaged;
      refused += ErrorOf(file_).empty() ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 4 * 16);  // those of the signature and more
}

}  // namespace
}  // namespace plm_vins
