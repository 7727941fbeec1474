// SPDX-License-Identifier: BSD-3-Clause
#include "offline/front_end.h"

#include <utility>

namespace plm_vins {

FrontEnd::FrontEnd(const Config& config) : points_(config) {
  if (config.use_lines) lines_.emplace(config);
}

void FrontEnd::AddImu(const ImuSample& sample) {
  points_.AddImu(sample);
  if (lines_) lines_->AddImu(sample);
}

void FrontEnd::AddImage(const ImageSample& image) {
  points_.AddImage(image);
  if (lines_) lines_->AddImage(image);
}

std::optional<FrontEndFrame> FrontEnd::Pop() {
  auto points = points_.Pop();
  if (!points) return std::nullopt;
  return FrontEndFrame{std::move(*points), lines_ ? lines_->Pop() : std::nullopt};
}

std::optional<FrontEndFrame> FrontEnd::Flush() {
  auto points = points_.Flush();
  if (!points) return std::nullopt;
  return FrontEndFrame{std::move(*points), lines_ ? lines_->Flush() : std::nullopt};
}

}  // namespace plm_vins
