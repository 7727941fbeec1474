// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/measurements.h"

namespace plm_vins::simulator {

// Writes a recording sample by sample in temporal order. Throws std::runtime_error with the name of
// a file that cannot be written; if the disk is full, in Finish() at the latest.
class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void Write(const ImuSample& sample) = 0;
  virtual void Write(const ImageSample& image) = 0;
  // Flushes all files; must be the last call.
  virtual void Finish() = 0;
};

}  // namespace plm_vins::simulator
