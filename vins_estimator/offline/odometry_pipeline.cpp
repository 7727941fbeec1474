// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/offline/odometry_pipeline.h"

#include <exception>
#include <thread>
#include <utility>

#include "common/bounded_queue.h"

namespace plm_vins {
namespace {

constexpr size_t kQueueCapacity = 200;  // items, most of them IMU samples: about a second

bool IsPowerOfTwo(int64_t count) { return (count & (count - 1)) == 0; }

}  // namespace

OdometryPipeline::OdometryPipeline(const Config& config) : front_end_(config), back_end_(config) {}

DropCounts OdometryPipeline::drops() const {
  DropCounts counts = ToDropCounts(front_end_.counts());
  Append(ToDropCounts(back_end_.statistics()), &counts);
  return counts;
}

void OdometryPipeline::Run(Recording* recording, RecordingInterval interval, Threads threads,
                           const FrameCallback& on_frame) {
  if (threads == Threads::kTwo) {
    RunInTwoThreads(recording, interval, on_frame);
  } else {
    RunFrontEnd(recording, interval, [&](Item item) {
      Consume(std::move(item), on_frame);
      return true;
    });
  }
  while (auto estimated = back_end_.Flush()) Report(std::move(*estimated), on_frame);
}

void OdometryPipeline::RunInTwoThreads(Recording* recording, const RecordingInterval& interval,
                                       const FrameCallback& on_frame) {
  BoundedQueue<Item> queue(kQueueCapacity);
  std::exception_ptr front_end_error;
  std::thread front_end([&] {
    try {
      RunFrontEnd(recording, interval, [&](Item item) { return queue.Push(std::move(item)); });
    } catch (...) {
      front_end_error = std::current_exception();
    }
    queue.Close();
  });
  std::exception_ptr back_end_error;
  try {
    while (auto item = queue.Pop()) Consume(std::move(*item), on_frame);
  } catch (...) {
    back_end_error = std::current_exception();
    queue.Close();
  }
  front_end.join();
  if (front_end_error) std::rethrow_exception(front_end_error);
  if (back_end_error) std::rethrow_exception(back_end_error);
}

void OdometryPipeline::RunFrontEnd(Recording* recording, RecordingInterval interval,
                                   const ItemCallback& emit) {
  while (const auto event = recording->Next()) {
    const RecordingInterval::Part part = interval.Locate(*event);
    if (part == RecordingInterval::Part::kEnd) break;
    if (part == RecordingInterval::Part::kUse && !Feed(*event, recording, emit)) return;
  }
  while (auto frame = front_end_.Flush()) {
    if (!EmitTracked(std::move(*frame), emit)) return;
  }
}

bool OdometryPipeline::Feed(const RecordingEvent& event, Recording* recording,
                            const ItemCallback& emit) {
  if (event.kind == RecordingEvent::Kind::kImu) {
    front_end_.AddImu(event.imu);
    if (!emit({std::nullopt, event.imu})) return false;
  } else if (const auto image = recording->LoadImage()) {
    if (!first_image_ns_) first_image_ns_ = event.t_ns;
    front_end_.AddImage({event.t_ns, *image});
  }
  while (auto frame = front_end_.Pop()) {
    if (!EmitTracked(std::move(*frame), emit)) return false;
  }
  return true;
}

bool OdometryPipeline::EmitTracked(TrackedFrame frame, const ItemCallback& emit) {
  // The last power of two lies in the second half of any run, however long it turns out to be.
  if (IsPowerOfTwo(++tracked_images_)) annotated_image_ = front_end_.tracker().DrawTracks();
  return emit({std::move(frame), {}});
}

void OdometryPipeline::Consume(Item item, const FrameCallback& on_frame) {
  if (!item.frame) {
    back_end_.AddImu(item.imu);
  } else {
    if (item.frame->restart) back_end_.Reset();
    if (item.frame->publish) {
      tracking_ms_[item.frame->points.t_ns] = item.frame->tracking_ms;
      back_end_.AddPoints(std::move(item.frame->points));
    }
  }
  while (auto estimated = back_end_.Pop()) Report(std::move(*estimated), on_frame);
}

void OdometryPipeline::Report(EstimatedFrame estimated, const FrameCallback& on_frame) {
  const int64_t t_ns = estimated.output.t_ns;
  const PipelineFrame frame{std::move(estimated.output), tracking_ms_[t_ns]};
  tracking_ms_.erase(tracking_ms_.begin(), tracking_ms_.upper_bound(t_ns));
  on_frame(frame);
}

}  // namespace plm_vins
