// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/measurements.h"

namespace plm_vins::simulator {

// Takes a recording sample by sample, in order of time. A file that cannot be written throws
// std::runtime_error naming it, on a full disk in Finish() at the latest.
class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void Write(const ImuSample& sample) = 0;
  virtual void Write(const ImageSample& image) = 0;
  // Nothing is written afterwards.
  virtual void Finish() = 0;
};

}  // namespace plm_vins::simulator
