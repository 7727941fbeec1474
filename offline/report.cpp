// SPDX-License-Identifier: BSD-3-Clause
#include "offline/report.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>

#include "common/format.h"

namespace plm_vins {
namespace {

// Share of the images, or of ten times as many IMU samples, beyond which a drop is reported.
constexpr double kManyDropped = 0.1;

// Returns the origin of the dropped input, if the cause of the drop identifies it.
std::string Origin(const DropCount& drop, const Source& source) {
  const auto begins_with = [&](const char* word) { return drop.cause.rfind(word, 0) == 0; };
  if (begins_with("images_without_")) return "";
  return begins_with("image") ? source.images : begins_with("imu") ? source.imu : "";
}

std::string Describe(const DropCount& drop, const Source& source) {
  const std::string origin = Origin(drop, source);
  return origin.empty() ? ToString(drop) : ToString(drop) + " from " + origin;
}

void WarnOfDrop(const DropCount& drop, const Source& source) {
  if (drop.count > 0) Warn(Describe(drop, source));
}

double Weight(const DropCount& drop) {
  return (drop.cause.rfind("imu", 0) == 0 ? 0.1 : 1.0) * static_cast<double>(drop.count);
}

// Returns the drop that concerns the largest share of the input; empty if all are small.
std::string WorstDrop(const RunSummary::Run& run, const Source& source) {
  const auto is_less = [](const DropCount& a, const DropCount& b) { return Weight(a) < Weight(b); };
  const auto worst = std::max_element(run.drops.begin(), run.drops.end(), is_less);
  const bool is_small =
      worst == run.drops.end() || Weight(*worst) <= kManyDropped * static_cast<double>(run.images);
  return is_small ? "" : Describe(*worst, source);
}

// Returns the most important problem of a run; empty if there was none.
std::string MostWrong(const RunSummary::Run& run, const Source& source, const RunReport& report) {
  if (!run.findings.empty()) return run.findings.front();
  std::string restart = report.LastRestart();
  if (!restart.empty()) return restart;
  std::string drop = WorstDrop(run, source);
  return drop.empty() ? report.WhyOftenWithoutPose() : drop;
}

// Returns why most images are of no use; empty if they are.
std::string ImageFault(const RunSummary::Run& run) {
  const auto is_of_most = [&](const DropCount& drop) {
    return drop.cause.rfind("images", 0) == 0 && 2 * drop.count > run.images;
  };
  const auto found = std::find_if(run.drops.begin(), run.drops.end(), is_of_most);
  return found == run.drops.end() ? "" : ToString(*found);
}

std::string WhyNone(const RunSummary::Run& run, const OdometryPipeline& pipeline,
                    const RunSummary& summary) {
  for (std::string finding :
       {pipeline.InputFinding(), pipeline.StillPartsFinding(), ImageFault(run)}) {
    if (!finding.empty()) return finding;
  }
  if (!summary.last_reason().empty()) return summary.last_reason();
  const bool dropped = std::any_of(run.drops.begin(), run.drops.end(),
                                   [](const DropCount& drop) { return drop.count > 0; });
  return dropped ? "none was usable, see the warnings" : "none between --start and --duration";
}

// Returns a warning if most images of a recording were not used; otherwise an empty string.
std::string UnusedWarning(int64_t unused, int64_t images) {
  if (2 * unused <= images) return "";
  return std::to_string(unused) + " of " + std::to_string(images) + " images were not used";
}

// Returns a warning if the IMU does not cover most images and no other problem was found; otherwise
// an empty string.
std::string UncoveredWarning(const RunSummary::Run& run, const OdometryPipeline& pipeline) {
  const auto is_uncovered = [&](const DropCount& drop) {
    return drop.cause == "frames_without_imu" && 2 * drop.count > run.images;
  };
  if (!pipeline.InputFinding().empty() || !run.first_image_ns ||
      std::none_of(run.drops.begin(), run.drops.end(), is_uncovered)) {
    return "";
  }
  const auto& first_imu_ns = pipeline.first_imu_ns();
  return "images begin at " + Format("%.3f s", ToSeconds(*run.first_image_ns)) +
         (first_imu_ns ? " and IMU samples at " + Format("%.3f s", ToSeconds(*first_imu_ns))
                       : " and no IMU sample comes before their end") +
         "; both must be stamped by the same clock";
}

// Returns a warning if most images have no pose; otherwise an empty string.
std::string PoselessWarning(int64_t poses, int64_t images) {
  if (poses == 0 || 2 * poses > images) return "";
  return std::to_string(images - poses) + " of " + std::to_string(images) + " images have no pose";
}

// Returns a warning if the timestamps of a recording jump back; otherwise an empty string.
std::string PartsWarning(const TimedFile& trajectory) {
  if (trajectory.parts() == 0) return "";
  return "stamps jumped back " + std::to_string(trajectory.parts()) +
         " times: earlier poses are in trajectory_1.tum, covariance_1.csv, ...";
}

}  // namespace

void Warn(const std::string& text) {
  if (!text.empty()) std::fprintf(stderr, "warning: %s\n", text.c_str());
}

int Report(const RunSummary::Run& run, const Source& source, const OdometryPipeline& pipeline,
           const RunReport& report, const ResultFiles& results) {
  const RunSummary& summary = results.summary();
  for (const std::string& finding : run.findings) Warn(finding);
  for (const DropCount& drop : run.drops) WarnOfDrop(drop, source);
  WarnOfDrop(results.unwritten_pictures(), source);
  Warn(UncoveredWarning(run, pipeline));
  Warn(UnusedWarning(pipeline.unused_images(), run.images));
  Warn(PoselessWarning(summary.poses(), run.images));
  Warn(PartsWarning(results.trajectory()));
  const bool has_trajectory = summary.poses() > 0;
  if (has_trajectory) {
    std::fprintf(stderr, "%" PRId64 " images, %" PRId64 " poses in %.1f s; results in %s\n",
                 run.images, summary.poses(), run.wall_time, results.folder().c_str());
  }
  for (const std::string& line : report.Lines(run.first_image_ns)) {
    std::fprintf(stderr, "%s\n", line.c_str());
  }
  if (!has_trajectory) {
    std::fprintf(stderr, "run_offline: no trajectory from %" PRId64 " images: %s\n", run.images,
                 WhyNone(run, pipeline, summary).c_str());
    return 1;
  }
  const std::string wrong = MostWrong(run, source, report);
  if (!wrong.empty()) std::fprintf(stderr, "most wrong: %s\n", wrong.c_str());
  return 0;
}

}  // namespace plm_vins
