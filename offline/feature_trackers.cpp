// SPDX-License-Identifier: BSD-3-Clause
#include "offline/feature_trackers.h"

#include <utility>

namespace plm_vins {

FeatureTrackers::FeatureTrackers(const Config& config) : points_(config) {
  if (config.use_lines) lines_.emplace(config);
}

void FeatureTrackers::AddImu(const ImuSample& sample) {
  points_.AddImu(sample);
  if (lines_) lines_->AddImu(sample);
}

void FeatureTrackers::AddImage(const ImageSample& image) {
  points_.AddImage(image);
  if (lines_) lines_->AddImage(image);
}

std::optional<TrackedFeatures> FeatureTrackers::Pop() {
  auto points = points_.Pop();
  if (!points) return std::nullopt;
  return TrackedFeatures{std::move(*points), lines_ ? lines_->Pop() : std::nullopt};
}

std::optional<TrackedFeatures> FeatureTrackers::Flush() {
  auto points = points_.Flush();
  if (!points) return std::nullopt;
  return TrackedFeatures{std::move(*points), lines_ ? lines_->Flush() : std::nullopt};
}

}  // namespace plm_vins
