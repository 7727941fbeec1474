// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "common/format.h"
#include "common/measurements.h"

namespace plm_vins {

// Detects images and IMU samples that were stamped by different clocks: for some seconds of both
// streams, their newest timestamps differ by more than any time offset. Samples must be added in
// order of arrival, with td added to image timestamps. Streams that start at different times, gaps,
// and transport stalls of less than kMinSpan_ns are not reported.
class ClockCheck {
 public:
  void AddImu(int64_t t_ns) { Add(t_ns, &imu_, images_); }
  void AddImage(int64_t t_ns) { Add(t_ns, &images_, imu_); }

  // Returns a message with both timestamps and their difference; empty for a common clock.
  std::string Finding(const std::string& image_topic, const std::string& imu_topic) const {
    if (!found_) return "";
    const double images = ToSeconds(found_->images_ns), imu = ToSeconds(found_->imu_ns);
    return "images (" + image_topic + ") and IMU (" + imu_topic + ") have different clocks: " +
           Format("stamps are %.3f s and %.3f s at a time, apart by %.1f s", images, imu,
                  images - imu) +
           "; stamp both by one clock";
  }

 private:
  // Timestamps of a stream since both streams were last within kApart_ns.
  struct Stream {
    std::optional<int64_t> first_ns;
    int64_t newest_ns = 0;

    bool IsLong() const { return first_ns && newest_ns - *first_ns > kMinSpan_ns; }
  };
  struct Stamps {
    int64_t images_ns = 0, imu_ns = 0;
  };

  static constexpr int64_t kApart_ns = 1'000'000'000;
  static constexpr int64_t kMinSpan_ns = 3'000'000'000;

  void Add(int64_t t_ns, Stream* stream, const Stream& other) {
    if (!stream->first_ns) stream->first_ns = t_ns;
    stream->newest_ns = t_ns;
    if (!other.first_ns) return;
    if (std::abs(t_ns - other.newest_ns) <= kApart_ns) {
      imu_.first_ns = imu_.newest_ns;
      images_.first_ns = images_.newest_ns;
      found_.reset();
    } else if (!found_ && imu_.IsLong() && images_.IsLong()) {
      found_ = {images_.newest_ns, imu_.newest_ns};
    }
  }

  Stream images_, imu_;
  std::optional<Stamps> found_;
};

}  // namespace plm_vins
