// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/streams/drop_counts.h"
#include "offline/pipeline/odometry_pipeline.h"
#include "offline/results/result_files.h"
#include "vins_estimator/output/run_report.h"

namespace plm_vins {

// Origin of the data that was processed, for messages.
struct Source {
  std::string name;
  std::string images, imu;  // file, or topic and key
  DropCounts problems;
};

// Prints a warning unless the text is empty.
void Warn(const std::string& text);

// Prints a summary of the run: unusable data, world frames, the time without a pose, and the most
// important finding. Returns the exit code, which is 0 if there is a trajectory.
int Report(const RunSummary::Run& run, const Source& source, const OdometryPipeline& pipeline,
           const RunReport& report, const ResultFiles& results);

}  // namespace plm_vins
