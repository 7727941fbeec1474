// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/run_report.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "common/format.h"
#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr double kLongestInterval = 1;               // between images; longer ones are gaps [s]
constexpr size_t kMostWorlds = 5, kMostReasons = 3;  // largest numbers that are reported
constexpr char kNoImage[] = "no usable image", kCollecting[] = "collecting images";

// Returns the reason without its figures, which change from image to image.
std::string Kind(const std::string& reason) {
  std::istringstream words(reason.substr(0, reason.find(": ")));
  std::string kind;
  for (std::string word; words >> word;) {
    const size_t end = word.find_first_not_of("0123456789.");
    const bool is_figure = std::isdigit(static_cast<unsigned char>(word[0])) != 0;
    kind += (kind.empty() ? "" : " ");
    kind += is_figure ? "N" + (end == std::string::npos ? "" : word.substr(end)) : word;
  }
  return kind;
}

}  // namespace

void RunReport::Add(const EstimatorOutput& output) {
  const double interval = Elapse(output.t_ns);
  if (interval <= kLongestInterval && !output.has_pose) {
    WithoutPose& without = without_pose_[Kind(output.reason)];
    without.time += interval;
    without.last_reason = output.reason;
  }
  if (output.restarted) restart_reason_ = output.reason;
  if (!output.has_pose || (!worlds_.empty() && !restart_reason_)) return;
  worlds_.push_back({elapsed_, restart_reason_.value_or("")});
  restart_reason_.reset();
}

void RunReport::End(int64_t last_image_ns) {
  if (newest_ns_) Elapse(last_image_ns);
}

double RunReport::Elapse(int64_t t_ns) {
  if (!first_ns_) first_ns_ = newest_ns_ = t_ns;
  const double interval = std::max(0.0, ToSeconds(t_ns - *newest_ns_));  // clocks may be set back
  newest_ns_ = t_ns;
  elapsed_ += interval;
  if (interval > kLongestInterval) {
    WithoutPose& without = without_pose_[kNoImage];
    without.time += interval;
    if (without.last_reason.empty()) without.last_reason = kNoImage;
  }
  return interval;
}

std::vector<std::string> RunReport::Lines(std::optional<int64_t> first_image_ns) const {
  if (elapsed_ == 0) return {};
  const double lead = first_image_ns ? std::max(0.0, ToSeconds(*first_ns_ - *first_image_ns)) : 0.0;
  std::vector<std::string> lines;
  if (!worlds_.empty()) lines.push_back(DescribeWorlds(lead));
  lines.push_back(DescribeTimeWithoutPose(lead));
  return lines;
}

std::string RunReport::DescribeWorlds(double lead) const {
  std::string text = std::to_string(worlds_.size()) +
                     (worlds_.size() == 1 ? " world frame: " : " unconnected world frames: ");
  for (size_t i = 0; i < std::min(worlds_.size(), kMostWorlds); ++i) {
    text += (i > 0 ? "; " : "") + Format("from %.2f s on", lead + worlds_[i].begin);
    if (!worlds_[i].reason.empty()) text += " (" + worlds_[i].reason + ")";
  }
  if (worlds_.size() <= kMostWorlds) return text;
  return text + "; and " + std::to_string(worlds_.size() - kMostWorlds) + " more";
}

std::string RunReport::DescribeTimeWithoutPose(double lead) const {
  double without = lead;
  for (const auto& [reason, spent] : without_pose_) without += spent.time;
  std::string text = Format("no pose for %.1f of %.1f s", without, lead + elapsed_);
  const std::vector<std::string> reasons = LongestFirst();
  for (size_t i = 0; i < std::min(reasons.size(), kMostReasons); ++i) {
    text += (i == 0 ? ": " : ", ") + reasons[i] +
            Format(" (%.1f s)", without_pose_.at(reasons[i]).time);
  }
  return text;
}

std::string RunReport::WhyOftenWithoutPose() const {
  double without = 0;
  for (const auto& [reason, spent] : without_pose_) without += spent.time;
  if (2 * without < elapsed_ || without == 0) return "";
  const std::vector<std::string> reasons = LongestFirst();
  // Each start begins by collecting images, so any other reason is the cause.
  const auto cause = std::find_if(reasons.begin(), reasons.end(),
                                  [](const auto& reason) { return reason != kCollecting; });
  return cause == reasons.end() ? kCollecting : without_pose_.at(*cause).last_reason;
}

std::vector<std::string> RunReport::LongestFirst() const {
  std::vector<std::string> reasons;
  for (const auto& [reason, spent] : without_pose_) {
    if (spent.time > 0) reasons.push_back(reason);
  }
  std::stable_sort(reasons.begin(), reasons.end(), [&](const auto& a, const auto& b) {
    return without_pose_.at(a).time > without_pose_.at(b).time;
  });
  return reasons;
}

}  // namespace plm_vins
