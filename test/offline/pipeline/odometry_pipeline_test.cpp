// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/odometry_pipeline.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "offline/pipeline/tracker_values.h"
#include "test/offline/pipeline/memory_recording.h"
#include "test/testing/still_scene.h"
#include "test/testing/temporary_folder.h"
#include "vins_estimator/output/pose_rows.h"

namespace plm_vins {
namespace {

using testing::kMillisecond;
using testing::kStart;
using testing::MemoryRecording;
using testing::StillConfig;
using testing::StillPicture;
using testing::StillRecording;

struct Result {
  std::string trajectory;
  std::vector<int64_t> frames;  // [ms]
  std::map<std::string, int64_t> drops;
};

void AddFrame(const PipelineFrame& frame, Result* result) {
  result->frames.push_back((frame.output.t_ns - kStart) / kMillisecond);
  if (!frame.output.has_pose) return;
  result->trajectory += FormatTumRow(frame.output.t_ns, frame.output.state.T_W_B());
}

Result RunPipeline(MemoryRecording recording, int threads = 1,
                   RecordingInterval interval = RecordingInterval(),
                   FeatureFileWriter* saved_features = nullptr) {
  Result result;
  OdometryPipeline pipeline(StillConfig());
  pipeline.SaveFeatures(saved_features);
  pipeline.Run(&recording, interval, threads, [&](const PipelineFrame& frame) {
    AddFrame(frame, &result);
    EXPECT_GT(frame.point_tracking_ms, 0);
  });
  for (const DropCount& drop : pipeline.drops()) result.drops[drop.cause] = drop.count;
  return result;
}

std::vector<int64_t> Steps(int64_t first, int64_t last) {
  std::vector<int64_t> stamps;
  for (int64_t t = first; t <= last; t += 50) stamps.push_back(t);
  return stamps;
}

TEST(OdometryPipeline, DrawsPointsAndLinesOfOneImage) {
  MemoryRecording recording = StillRecording(400);
  OdometryPipeline pipeline(StillConfig());
  EXPECT_TRUE(pipeline.points_image().empty());
  pipeline.Run(&recording, {}, 2, [](const PipelineFrame&) {});
  for (const cv::Mat& image : {pipeline.points_image(), pipeline.lines_image()}) {
    EXPECT_EQ(image.size(), StillPicture().size());
    EXPECT_EQ(image.type(), CV_8UC3);
  }
}

TEST(OdometryPipeline, EndsOnRequest) {
  const testing::TemporaryFolder folder;
  for (const int threads : {1, 4}) {
    MemoryRecording recording = StillRecording(3000);
    OdometryPipeline pipeline(StillConfig());
    FeatureFileWriter writer(folder.File("features"), TrackerValues(StillConfig()));
    pipeline.SaveFeatures(&writer);
    int measurements = 0;  // 11 for each image
    pipeline.EndWhere([&] { return ++measurements > 220; });
    pipeline.Run(&recording, {}, threads, [](const PipelineFrame&) {});
    writer.Close();
    EXPECT_EQ(pipeline.images(), 20);
    EXPECT_EQ(pipeline.last_frame_ns(), kStart + 960 * kMillisecond);
  }
  FeatureFileReader reader(folder.File("features"));
  OdometryPipeline pipeline(StillConfig());
  int measurements = 0;
  pipeline.EndWhere([&] { return ++measurements > 110; });
  pipeline.Run(&reader, {}, [](const PipelineFrame&) {});
  EXPECT_LT(pipeline.images(), 11);
}

TEST(OdometryPipeline, DrawsTracksAtTheInterval) {
  MemoryRecording recording = StillRecording(400);  // an image every 50 ms
  OdometryPipeline pipeline(StillConfig());
  std::vector<int64_t> stamps_ns;
  pipeline.ShowTracks(0.1, [&](int64_t t_ns, const cv::Mat& points, const cv::Mat& lines) {
    stamps_ns.push_back(t_ns);
    for (const cv::Mat& image : {points, lines}) {
      EXPECT_EQ(image.size(), StillPicture().size());
      EXPECT_EQ(image.type(), CV_8UC3);
    }
  });
  pipeline.Run(&recording, {}, 2, [](const PipelineFrame&) {});
  ASSERT_GE(stamps_ns.size(), 3u);
  for (size_t i = 1; i < stamps_ns.size(); ++i) {
    EXPECT_EQ(stamps_ns[i] - stamps_ns[i - 1], 100'000'000);
  }
}

TEST(OdometryPipeline, TracksLinesOnlyIfUsed) {
  for (const bool use_lines : {false, true}) {
    MemoryRecording recording = StillRecording(400);
    Config config = StillConfig();
    config.use_lines = use_lines;
    OdometryPipeline pipeline(config);
    pipeline.Run(&recording, {}, 1, [&](const PipelineFrame& frame) {
      EXPECT_EQ(frame.line_tracking_ms > 0, use_lines);
      EXPECT_LE(frame.line_tracking.detection_ms, frame.line_tracking_ms);
    });
    EXPECT_EQ(pipeline.lines_image().empty(), !use_lines);
  }
}

TEST(OdometryPipeline, GivesEveryImageItsResult) {
  const Result result = RunPipeline(StillRecording(3000));
  EXPECT_EQ(result.frames, Steps(10, 2960));
  EXPECT_FALSE(result.trajectory.empty());
  for (const auto& [cause, count] : result.drops) EXPECT_EQ(count, 0) << cause;
}

TEST(OdometryPipeline, MoreThreadsGiveTheSameBytesAsOne) {
  const Result one = RunPipeline(StillRecording(3000), 1);
  for (const int threads : {2, 3, 4}) {
    const Result more = RunPipeline(StillRecording(3000), threads);
    EXPECT_EQ(one.frames, more.frames);
    EXPECT_EQ(one.trajectory, more.trajectory);
    EXPECT_EQ(one.drops, more.drops);
  }
}

TEST(OdometryPipeline, SavedFeaturesGiveTheSameBytesAsTheImages) {
  const testing::TemporaryFolder folder;
  const std::string file = folder.File("flight.features");
  const Result images = [&] {
    FeatureFileWriter writer(file, TrackerValues(StillConfig()));
    Result result = RunPipeline(StillRecording(3000), 2, {}, &writer);
    writer.Close();
    return result;
  }();
  Result features;
  OdometryPipeline pipeline(StillConfig());
  FeatureFileReader reader(file);
  pipeline.Run(&reader, {}, [&](const PipelineFrame& frame) { AddFrame(frame, &features); });
  EXPECT_FALSE(images.trajectory.empty());
  EXPECT_EQ(features.frames, images.frames);
  EXPECT_EQ(features.trajectory, images.trajectory);
  EXPECT_EQ(pipeline.images(), 60);
}

TEST(OdometryPipeline, CountsImagesWithoutExpectedLines) {
  const testing::TemporaryFolder folder;
  const std::string file = folder.File("flight.features");
  Config config = StillConfig();
  config.use_lines = false;
  {
    MemoryRecording recording = StillRecording(1000);
    OdometryPipeline pipeline(config);
    FeatureFileWriter writer(file, TrackerValues(config));
    pipeline.SaveFeatures(&writer);
    pipeline.Run(&recording, {}, 1, [](const PipelineFrame&) {});
    writer.Close();
  }
  for (const bool use_lines : {false, true}) {
    config.use_lines = use_lines;
    OdometryPipeline pipeline(config);
    FeatureFileReader reader(file);
    pipeline.Run(&reader, {}, [](const PipelineFrame&) {});
    const DropCount last = pipeline.drops().back();
    EXPECT_EQ(last.cause, "frames_without_lines");
    EXPECT_EQ(last.count, use_lines ? 20 : 0);
  }
}

TEST(OdometryPipeline, ProcessesTheInterval) {
  const Result result = RunPipeline(StillRecording(3000), 2, RecordingInterval(0.5, 1.0));
  EXPECT_EQ(result.frames, Steps(510, 1510));
}

TEST(OdometryPipeline, SkipsUnreadableAndWrongImages) {
  MemoryRecording recording;
  for (int t = 0; t <= 500; t += 5) {
    recording.AddImu(t);
    if (t == 110) recording.AddImage(t, cv::Mat());
    if (t == 210) recording.AddImage(t, StillPicture({160, 120}));
    if (t == 310) recording.AddImage(10);
    if (t % 50 == 10 && t != 110 && t != 210) recording.AddImage(t);
  }
  const Result result = RunPipeline(std::move(recording));
  EXPECT_EQ(result.frames, (std::vector<int64_t>{10, 60, 160, 260, 310, 360, 410, 460}));
  EXPECT_EQ(result.drops.at("images_wrong_format"), 1);
  EXPECT_EQ(result.drops.at("images_out_of_order"), 1);
}

TEST(OdometryPipeline, RestartsOnceIfTheRecordingRestarts) {
  MemoryRecording recording = StillRecording(2000);
  for (int t = -4000; t <= -1000; t += 5) {
    recording.AddImu(t);
    if (t % 50 == -40) recording.AddImage(t);
  }
  std::vector<std::string> restarts;
  int poses_before = 0, poses_after = 0;
  OdometryPipeline pipeline(StillConfig());
  pipeline.Run(&recording, {}, 1, [&](const PipelineFrame& frame) {
    if (frame.output.restarted) restarts.push_back(frame.output.reason);
    if (frame.output.has_pose) ++(restarts.empty() ? poses_before : poses_after);
  });
  EXPECT_EQ(restarts, (std::vector<std::string>{"timestamps jumped back"}));
  EXPECT_GT(poses_before, 20);
  EXPECT_GT(poses_after, 20);
}

TEST(OdometryPipeline, SkipsBadImuSamples) {
  MemoryRecording recording = StillRecording(1000);
  recording.events()[20].imu.gyro.x() = std::numeric_limits<double>::quiet_NaN();
  recording.events()[40].imu.t_ns = kStart;
  const Result result = RunPipeline(std::move(recording));
  EXPECT_EQ(result.frames, Steps(10, 960));
  EXPECT_EQ(result.drops.at("imu_not_finite"), 1);
  EXPECT_EQ(result.drops.at("imu_out_of_order"), 1);
}

TEST(OdometryPipeline, StartsAfterAFirstImageWithAWrongStamp) {
  for (const int64_t wrong_ns : {int64_t{0}, kStart + 1'000'000'000'000'000}) {
    MemoryRecording recording = StillRecording(3000);
    for (RecordingEvent& event : recording.events()) {
      if (event.kind != RecordingEvent::Kind::kImage) continue;
      event.t_ns = wrong_ns;
      break;
    }
    OdometryPipeline pipeline(StillConfig());
    int poses = 0;
    pipeline.Run(&recording, RecordingInterval(0, 2), 1,
                 [&](const PipelineFrame& frame) { poses += frame.output.has_pose ? 1 : 0; });
    EXPECT_EQ(pipeline.first_image_ns(), kStart + 60 * kMillisecond);
    EXPECT_GT(poses, 10);
  }
}

TEST(OdometryPipeline, CountsUnreadableImages) {
  MemoryRecording recording = StillRecording(200);  // with images at 10, 60, 110 and 160 ms
  recording.AddImage(210, cv::Mat());
  OdometryPipeline pipeline(StillConfig());
  pipeline.Run(&recording, {}, 1, [](const PipelineFrame&) {});
  EXPECT_EQ(pipeline.images(), 5);
  EXPECT_EQ(pipeline.unused_images(), 1);
}

TEST(OdometryPipeline, CountsUnusedImages) {
  Config config = StillConfig();
  config.publish_rate = 10;  // skipped images are not lost
  OdometryPipeline pipeline(config);
  MemoryRecording recording = StillRecording(1000);
  int64_t images = 0;
  for (RecordingEvent& event : recording.events()) {
    if (event.kind == RecordingEvent::Kind::kImage && ++images > 15) event.t_ns = kStart;
  }
  pipeline.Run(&recording, {}, 1, [](const PipelineFrame&) {});
  EXPECT_EQ(pipeline.images(), images);
  EXPECT_EQ(pipeline.unused_images(), images - 15);
}

TEST(OdometryPipeline, ReportsAMissingImu) {
  MemoryRecording recording;
  for (int t = 0; t < 500; t += 50) recording.AddImage(t);
  const Result result = RunPipeline(std::move(recording));
  EXPECT_TRUE(result.frames.empty());
  EXPECT_EQ(result.drops.at("frames_without_imu"), 10);
}

TEST(OdometryPipeline, ReportsTheStartOfAnUnusedImu) {
  MemoryRecording recording;
  for (int t = 0; t < 500; t += 50) recording.AddImage(t);
  for (int t = 100'000; t < 100'500; t += 5) recording.AddImu(t);
  OdometryPipeline pipeline(StillConfig());
  pipeline.Run(&recording, RecordingInterval(0, 2), 1, [](const PipelineFrame&) {});
  EXPECT_EQ(pipeline.first_image_ns(), kStart);
  EXPECT_EQ(pipeline.first_imu_ns(), kStart + 100'000 * kMillisecond);
}

TEST(OdometryPipeline, PropagatesExceptionsOfTheRecording) {
  for (const int threads : {1, 2, 3, 4}) {
    MemoryRecording recording = StillRecording(300);
    recording.Fail();
    EXPECT_THROW(RunPipeline(recording, threads), std::runtime_error);
  }
}

TEST(OdometryPipeline, PropagatesExceptionsOfTheReceiver) {
  for (const int threads : {1, 2, 3, 4}) {
    MemoryRecording recording = StillRecording(3000);
    OdometryPipeline pipeline(StillConfig());
    EXPECT_THROW(pipeline.Run(&recording, RecordingInterval(), threads,
                              [](const PipelineFrame&) { throw std::runtime_error("disk full"); }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace plm_vins
