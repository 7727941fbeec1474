// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// Counts of unusable line frames by cause, since construction.
struct LinePairingStatistics {
  int64_t frames_without_lines = 0;  // images output without the expected lines
  int64_t lines_out_of_order = 0;    // timestamp not increasing
  int64_t lines_late = 0;            // arrived after the image had been output
  int64_t lines_without_points = 0;  // the point frame never arrived
};

// Pairs line frames with images by equal timestamps and decides how long an image waits for its
// lines: until they arrive, a later line frame arrives, or the image is `max_lag` images behind.
// Lines that arrived in time before may be `max_stall` late for some images, so that a stall of the
// transport changes nothing. If line frames are missing permanently, images no longer wait, until
// the lines of an image with points arrive in time again.
class LinePairing {
 public:
  struct Options {
    bool expected;     // images wait (up to max_lag) for their line frames
    int max_lag;       // longest wait [images]
    double max_stall;  // longest wait after a stall, up to the newest image [s]
    int patience;      // consecutive images without lines after which lines are missing; longest
                       // stall
    int max_frames;    // longest queue of line frames; beyond, the oldest is dropped
  };

  // Images with points that are newer than one which waits for its lines.
  struct NewerImages {
    int count = 0;
    double duration = 0;  // from that image to the newest one [s]
  };

  explicit LinePairing(const Options& options)
      : options_(options), delayed_in_a_row_(options.patience) {}

  // `image_waits`: the points of that image have arrived and were not output yet.
  void Add(LineFrame frame, bool image_waits);

  // Returns whether the image need not wait for its lines.
  bool AreDecided(int64_t image_ns, const NewerImages& newer) const;

  // Returns the lines of an image that is output, if available. Images must be in order of time.
  std::optional<LineFrame> Take(int64_t image_ns, const NewerImages& newer);

  // Drops frames and timestamps, keeps the statistics and whether lines are missing.
  void Clear();

  // Returns whether expected lines are missing permanently.
  bool are_missing() const {
    return options_.expected && images_without_in_a_row_ >= options_.patience;
  }

  // Returns whether lines do arrive, but their timestamps match no image.
  bool are_of_other_images() const {
    return are_missing() && 2 * unpaired_in_a_row_ >= options_.patience;
  }

  const LinePairingStatistics& statistics() const { return statistics_; }

 private:
  // Returns whether the image was output recently enough that it would still wait for its lines.
  bool WasTakenLately(int64_t image_ns) const;
  void DropBefore(int64_t image_ns);
  // Returns whether a line frame of this image or of a later one has arrived.
  bool HaveReached(int64_t image_ns) const;

  const Options options_;
  LinePairingStatistics statistics_;
  std::deque<LineFrame> frames_;      // ordered by time
  std::optional<int64_t> newest_ns_;  // time of the newest frame, repeated frames excluded
  std::deque<int64_t> taken_ns_;      // the last `max_lag` images that were output
  int images_without_in_a_row_ = 0;
  int delayed_in_a_row_;  // images that waited for longer than `max_lag`
  int unpaired_in_a_row_ = 0;
};

}  // namespace plm_vins
