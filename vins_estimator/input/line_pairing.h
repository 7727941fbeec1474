// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// What of the lines could not be used, by cause. All counts are since construction.
struct LinePairingStatistics {
  int64_t frames_without_lines = 0;  // handed out without the line frame that was expected
  int64_t lines_out_of_order = 0;    // stamp not after the one before
  int64_t lines_late = 0;            // came after a frame of that time or later had been handed out
  int64_t lines_without_points = 0;  // line frame whose point frame never came
};

// Keeps line frames for the images that they are of, by equal stamp, and knows how long an image
// should wait for its own: until it is there, a later one is there, or there is an image `max_lag`
// images ahead. Where line frames fail to come at all, images no longer wait for them, until one of
// an image that has points comes in time again.
class LinePairing {
 public:
  struct Options {
    bool expected;   // images wait (a little) for their line frames
    int max_lag;     // images to wait
    int patience;    // images in a row without lines until the lines count as missing
    int max_frames;  // queued line frames; beyond, the oldest is dropped
  };

  explicit LinePairing(const Options& options) : options_(options) {}

  // `image_waits`: the points of that image are there and were not handed out yet.
  void Add(LineFrame frame, bool image_waits);

  // Whether the lines of this image need not be waited for, `newer_images` being there.
  bool AreDecided(int64_t image_ns, int newer_images) const;

  // The lines of an image that is handed out, if they are there. In order of time.
  std::optional<LineFrame> Take(int64_t image_ns);

  // Forgets frames and stamps; not that lines are missing, nor the statistics.
  void Clear();

  // Lines are expected but fail to come.
  bool are_missing() const {
    return options_.expected && images_without_in_a_row_ >= options_.patience;
  }

  // The lines that are missing do come, but of images of which no points come.
  bool are_of_other_images() const {
    return are_missing() && 2 * unpaired_in_a_row_ >= options_.patience;
  }

  const LinePairingStatistics& statistics() const { return statistics_; }

 private:
  // The image was handed out so lately that it would still wait for its lines if images did.
  bool WasTakenLately(int64_t image_ns) const;
  void DropBefore(int64_t image_ns);

  const Options options_;
  LinePairingStatistics statistics_;
  std::deque<LineFrame> frames_;      // in order of time
  std::optional<int64_t> newest_ns_;  // stamp of the last frame that was not a repetition
  std::deque<int64_t> taken_ns_;      // images handed out, as many as a line frame may lag behind
  int images_without_in_a_row_ = 0;
  int unpaired_in_a_row_ = 0;
};

}  // namespace plm_vins
