// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/streams/drop_counts.h"

namespace plm_vins {

// Counts the images of camera 0 that lack the image of another camera or of depth, and tells why:
// those that come are unusable, all timestamps are off by the same time, or fewer come.
class MissingImages {
 public:
  // `cause` names the count.
  explicit MissingImages(const std::string& cause) : count_{cause, 0, ""} {}

  // Adds an image at `t_ns` that came but cannot be used, for the reason `why`.
  void AddUnusable(int64_t t_ns, const std::string& why);

  // Adds an image of camera 0 that has its partner.
  void AddPaired(int64_t t_ns);

  // Adds an image of camera 0 that lacks it. `last_ns` is the timestamp of the newest usable one.
  void AddMissing(int64_t t_ns, const std::optional<int64_t>& last_ns);

  // The detail is the cause that has lasted for twenty images; before, that of the first image.
  const DropCount& count() const { return count_; }

 private:
  struct Unusable {
    int64_t t_ns;
    std::string why;
  };

  void AddLate(double later);
  void JudgeRate(double interval);

  DropCount count_;
  std::optional<Unusable> unusable_;  // the newest
  std::optional<int64_t> paired_ns_;  // the newest
  int missing_since_pair_ = 0;
  int same_offsets_ = 0, same_gaps_ = 0;  // in a row
  double last_offset_ = 0;                // [s]
  int last_gap_ = 0;                      // [images of camera 0]
};

}  // namespace plm_vins
