// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "offline/pipeline/odometry_pipeline.h"
#include "offline/pipeline/tracker_values.h"
#include "test/offline/pipeline/memory_recording.h"
#include "test/testing/still_scene.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using testing::kMillisecond;
using testing::kStart;
using testing::MemoryRecording;
using testing::StillConfig;
using testing::StillPicture;
using testing::StillRecording;

TEST(PipelineFrame, BoundsTheImagesThatTheImuDoesNotCover) {
  for (const bool loop_closure : {false, true}) {
    MemoryRecording recording;
    const cv::Mat picture = StillPicture().clone();
    for (int i = 0; i < 500; ++i) recording.AddImage(50 * i, picture);
    const int in_recording = picture.u->refcount;
    Config config = StillConfig();
    config.pose_graph.loop_closure = loop_closure;
    OdometryPipeline pipeline(config);
    pipeline.Run(&recording, {}, 1, [](const PipelineFrame&) {});
    EXPECT_LT(picture.u->refcount - in_recording, loop_closure ? 350 : 10);
  }
}

TEST(PipelineFrame, HasPixelsForLoopClosureOnly) {
  for (const bool loop_closure : {false, true}) {
    MemoryRecording recording = StillRecording(400);
    Config config = StillConfig();
    config.pose_graph.loop_closure = loop_closure;
    OdometryPipeline pipeline(config);
    int frames = 0;
    pipeline.Run(&recording, {}, 2, [&](const PipelineFrame& frame) {
      EXPECT_EQ(frame.images.empty(), !loop_closure);
      ++frames;
    });
    EXPECT_GT(frames, 5);
  }
}

// Expects that the frames contain all input samples exactly once.
void ExpectImuOf(const std::vector<PipelineFrame>& frames) {
  ASSERT_FALSE(frames.empty());
  int64_t t_ns = kStart;  // of the next sample
  for (const PipelineFrame& frame : frames) {
    for (const ImuSample& sample : frame.imu) {
      EXPECT_EQ(sample.t_ns, t_ns);
      EXPECT_LE(sample.t_ns, frame.output.t_ns);
      t_ns += 5 * kMillisecond;
    }
    ASSERT_FALSE(frame.imu.empty());
    EXPECT_EQ(frame.imu.back().t_ns, frame.imu_ns);
    EXPECT_GT(t_ns, frame.output.t_ns);
  }
}

TEST(PipelineFrame, HasTheImuSamplesSinceThePreviousFrame) {
  const testing::TemporaryFolder folder;
  std::vector<PipelineFrame> frames;
  const auto keep = [&](const PipelineFrame& frame) { frames.push_back(frame); };
  for (const int threads : {1, 4}) {
    MemoryRecording recording = StillRecording(1000);
    OdometryPipeline pipeline(StillConfig());
    FeatureFileWriter writer(folder.File("features"), TrackerValues(StillConfig()));
    pipeline.SaveFeatures(&writer);
    pipeline.Run(&recording, {}, threads, keep);
    writer.Close();
    ExpectImuOf(frames);
    frames.clear();
  }
  FeatureFileReader reader(folder.File("features"));
  OdometryPipeline pipeline(StillConfig());
  pipeline.Run(&reader, {}, keep);
  ExpectImuOf(frames);
}

TEST(PipelineFrame, HasNoImuSampleBeforeABackwardJump) {
  MemoryRecording recording = StillRecording(2000);
  for (int t = -4000; t <= -1000; t += 5) {
    recording.AddImu(t);
    if (t % 50 == -40) recording.AddImage(t);
  }
  std::vector<PipelineFrame> after;
  OdometryPipeline pipeline(StillConfig());
  pipeline.Run(&recording, {}, 1, [&](const PipelineFrame& frame) {
    if (frame.output.t_ns < kStart) after.push_back(frame);
  });
  int64_t last_ns = 0;
  size_t samples = 0;
  for (const PipelineFrame& frame : after) {
    for (const ImuSample& sample : frame.imu) {
      EXPECT_GT(sample.t_ns, last_ns);
      EXPECT_LE(sample.t_ns, frame.output.t_ns);
      last_ns = sample.t_ns;
      ++samples;
    }
  }
  EXPECT_GT(samples, 400u);
}

}  // namespace
}  // namespace plm_vins
