// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_aliases.h"

#include <stdexcept>
#include <utility>

namespace plm_vins {
namespace {

double Length(const LineObservation& line) { return (line.end - line.start).norm(); }

}  // namespace

void LineAliases::Add(int64_t newer, int64_t older) {
  if (older >= newer) throw std::invalid_argument("a line can only be absorbed by an older one");
  const int64_t landmark = Resolve(older);
  for (auto& [id, alias] : aliases_) {
    if (alias.older == newer) alias.older = landmark;
  }
  aliases_[newer] = {landmark, image_};
}

int64_t LineAliases::Resolve(int64_t id) const {
  const auto alias = aliases_.find(id);
  return alias == aliases_.end() ? id : alias->second.older;
}

LineFrame LineAliases::Redirect(const LineFrame& frame) {
  ++image_;
  std::map<std::pair<int, int64_t>, LineObservation> longest;  // by camera and landmark
  for (const LineObservation& line : frame.lines) {
    const auto alias = aliases_.find(line.id);
    if (alias != aliases_.end()) alias->second.last_seen = image_;
    LineObservation redirected = line;
    redirected.id = Resolve(line.id);
    const auto [place, is_first] =
        longest.emplace(std::pair(line.camera, redirected.id), redirected);
    if (!is_first && Length(redirected) > Length(place->second)) place->second = redirected;
  }
  for (auto it = aliases_.begin(); it != aliases_.end();) {
    it = image_ - it->second.last_seen > kMemory ? aliases_.erase(it) : std::next(it);
  }
  LineFrame result;
  result.t_ns = frame.t_ns;
  for (const auto& [key, line] : longest) result.lines.push_back(line);
  return result;
}

void LineAliases::RemoveUnless(const std::function<bool(int64_t)>& landmark_exists) {
  for (auto it = aliases_.begin(); it != aliases_.end();) {
    it = landmark_exists(it->second.older) ? std::next(it) : aliases_.erase(it);
  }
}

}  // namespace plm_vins
