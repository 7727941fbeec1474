// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace plm_vins {

// Which of the states at IMU rate go on to an autopilot, by their stamps alone: those at a given
// mean rate, as long as images support them. An estimator that is lost sends no states; one without
// images still sends the IMU's, which are soon worth nothing. Stamps of images do not count: they
// are of the camera's clock, which td may set off by as much as a second.
//
// After every interruption the world may be a new one, so the autopilot must begin anew. It has to
// notice: there is a pause, and a count.
class RelayGate {
 public:
  struct Options {
    double rate = 30;        // [Hz], 0.1 to 1000
    double max_age = 0.5;    // since an image's estimate came [s], 0.001 to 1000
    double min_pause = 1.0;  // of what goes on, at an interruption [s], 0.001 to 1000
  };

  // Throws std::invalid_argument, which names the option, where one is out of its range.
  explicit RelayGate(const Options& options);

  // An image has been estimated: it supports the states from the newest one on.
  void AddImage() { image_ns_ = state_ns_; }

  // Whether the state of this time goes on.
  bool Pass(int64_t t_ns);

  bool is_interrupted() const { return is_interrupted_; }
  // Interruptions after which it went on.
  int64_t resets() const { return resets_; }

 private:
  bool IsUsable(int64_t t_ns) const;
  bool IsDue(int64_t t_ns);

  const Options options_;
  std::optional<int64_t> image_ns_;   // of the state that was the newest when an image came
  std::optional<int64_t> state_ns_;   // the newest
  std::optional<int64_t> passed_ns_;  // the newest that went on
  int64_t due_ns_ = 0;                // when the next one is to go on
  bool is_interrupted_ = true;
  int64_t resets_ = 0;
};

}  // namespace plm_vins
