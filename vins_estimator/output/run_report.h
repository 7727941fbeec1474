// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Summarizes a run in words: its world frames and why each began, and the time without a pose and
// why.
class RunReport {
 public:
  // Adds an output; outputs must be in order of arrival.
  void Add(const EstimatorOutput& output);

  // Adds the time from the last output to the last image, used or not.
  void End(int64_t last_image_ns);

  // Returns a line on the world frames and one on the time without a pose. Times are since the
  // first image, used or not, if its timestamp is known, otherwise since the first output.
  std::vector<std::string> Lines(std::optional<int64_t> first_image_ns) const;

  // Returns why the newest world frame replaced another; empty if there was only one.
  std::string LastRestart() const { return worlds_.size() > 1 ? worlds_.back().reason : ""; }

  // Returns the most frequent reason other than collecting images, if there is another, as it was
  // last given, while at least half of the time has no pose; otherwise an empty string.
  std::string WhyOftenWithoutPose() const;

 private:
  struct WithoutPose {
    double time = 0;          // [s]
    std::string last_reason;  // with figures and what to do
  };
  struct World {
    double begin = 0;    // first pose, since the first output [s]
    std::string reason;  // why the previous one ended
  };

  // Returns the time since the previous call [s], which has no pose if it is a gap.
  double Elapse(int64_t t_ns);
  std::string DescribeWorlds(double lead) const;
  std::string DescribeTimeWithoutPose(double lead) const;
  // Returns the reasons for times without a pose, the longest time first.
  std::vector<std::string> LongestFirst() const;

  std::vector<World> worlds_;
  std::optional<std::string> restart_reason_;  // reason for the next world
  std::optional<int64_t> first_ns_, newest_ns_;
  double elapsed_ = 0;                               // since the first output [s]
  std::map<std::string, WithoutPose> without_pose_;  // by reason without its figures
};

}  // namespace plm_vins
