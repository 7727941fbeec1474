// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>

#include "common/measurements.h"

namespace plm_vins {

// Maps line tracks to landmarks after several tracks were found to be one line. An alias leads from
// a newer id to an older one, in one step. It is dropped when its track was not observed for
// kMemory images, which bounds the table.
class LineAliases {
 public:
  static constexpr int64_t kMemory = 100;  // [images]

  // Assigns the observations of `newer`, and of all tracks that were mapped to it, to `older`.
  // Throws std::invalid_argument unless older < newer.
  void Add(int64_t newer, int64_t older);

  // Returns the landmark of a track; the track's own id if it has no alias.
  int64_t Resolve(int64_t id) const;

  // Returns one image's lines under their landmarks' ids. If several segments belong to one
  // landmark, the longest is kept.
  LineFrame Redirect(const LineFrame& frame);

  // Drops the aliases of landmarks that no longer exist.
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
