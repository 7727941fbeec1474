// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/feature_trackers.h"

#include <future>
#include <utility>

namespace plm_vins {

FeatureTrackers::FeatureTrackers(const Config& config) : points_(config) {
  if (config.use_lines) lines_.emplace(config);
}

void FeatureTrackers::AddImu(const ImuSample& sample) {
  points_.AddImu(sample);
  if (lines_) lines_->AddImu(sample);
}

void FeatureTrackers::AddImage(int camera, const ImageSample& image) {
  points_.AddImage(camera, image);
  if (lines_) lines_->AddImage(camera, image);
}

void FeatureTrackers::AddDepth(const DepthSample& image) {
  points_.AddDepth(image);
  if (lines_) lines_->AddDepth(image);  // both trackers then wait for the same images
}

template <typename TrackOne>
std::optional<TrackedFeatures> FeatureTrackers::TrackBoth(const TrackOne& track) {
  if (!points_.waiting()) return std::nullopt;
  std::future<std::optional<TrackedLines>> lines;
  if (lines_) {
    const auto when = side_by_side_ ? std::launch::async : std::launch::deferred;
    lines = std::async(when, [&] { return track(&*lines_); });
  }
  auto points = track(&points_);
  if (!points) return std::nullopt;
  return TrackedFeatures{std::move(*points), lines_ ? lines.get() : std::nullopt};
}

std::optional<TrackedFeatures> FeatureTrackers::Pop() {
  return TrackBoth([](auto* stage) { return stage->Pop(); });
}

std::optional<TrackedFeatures> FeatureTrackers::Flush() {
  return TrackBoth([](auto* stage) { return stage->Flush(); });
}

}  // namespace plm_vins
