// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>

#include "common/measurements.h"

namespace plm_vins {

// Which landmark the observations of a track belong to, after several tracks turned out to be one
// line. An alias always leads from a newer to an older id, in one step. It is dropped when its
// track has not been seen for kMemory images, which bounds the table.
class LineAliases {
 public:
  static constexpr int64_t kMemory = 100;  // [images]

  // From here on the observations of `newer`, and of all tracks that led there, belong to `older`
  // (std::invalid_argument unless older < newer).
  void Add(int64_t newer, int64_t older);

  // The landmark of a track; the track itself where it has no alias.
  int64_t Resolve(int64_t id) const;

  // One image's lines under the ids of their landmarks. Where several tracks of one landmark are
  // seen at once, the longest segment stays.
  LineFrame Redirect(const LineFrame& frame);

  // Drops the aliases that lead to landmarks that are no more.
  void RemoveUnless(const std::function<bool(int64_t)>& landmark_exists);

  size_t size() const { return aliases_.size(); }

 private:
  struct Alias {
    int64_t older = -1;
    int64_t last_seen = 0;  // image number
  };

  std::map<int64_t, Alias> aliases_;
  int64_t image_ = 0;  // number of the newest image
};

}  // namespace plm_vins
