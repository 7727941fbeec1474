// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace plm_vins {

// Selects, by timestamp only, which of the states at IMU rate are relayed to an autopilot: those at
// a given mean rate, as long as images are processed. An estimator that has lost tracking sends no
// states; one without images still propagates the IMU, which soon becomes useless. The timestamps
// of images are ignored: they are in camera time, which td may shift by as much as a second.
//
// After every interruption the world frame may be a new one, so the autopilot has to reset its
// estimate. A pause of the relayed states and a reset counter announce this.
class RelayGate {
 public:
  // `rate` is that of the relayed states [Hz], 0.1 to 1000. Throws std::invalid_argument if it is
  // out of range.
  explicit RelayGate(double rate);

  // Reports a processed image, which supports the states from the newest one on.
  void AddImage() { image_ns_ = state_ns_; }

  // Returns whether to relay the state of this time.
  bool Pass(int64_t t_ns);

  bool is_interrupted() const { return is_interrupted_; }
  // Number of interruptions after which relaying resumed.
  int64_t resets() const { return resets_; }

 private:
  bool IsUsable(int64_t t_ns) const;
  bool IsDue(int64_t t_ns);

  const double rate_;
  std::optional<int64_t> image_ns_;   // newest state when the last image came
  std::optional<int64_t> state_ns_;   // newest state
  std::optional<int64_t> passed_ns_;  // newest relayed state
  int64_t due_ns_ = 0;                // time of the next state to relay
  bool is_interrupted_ = true;
  int64_t resets_ = 0;
};

}  // namespace plm_vins
