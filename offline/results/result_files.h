// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/io/output_file.h"
#include "common/streams/drop_counts.h"
#include "offline/pipeline/odometry_pipeline.h"
#include "offline/results/timed_file.h"
#include "vins_estimator/output/ply_writer.h"
#include "vins_estimator/output/run_summary.h"

namespace plm_vins {

// Writes the results of an offline run to their folder: trajectory.tum, covariance.csv, timing.csv,
// summary.json, map.ply, lines.ply, lines.obj, tracks.png, line_tracks.png, tracks/, and
// calibrated.yaml if the calibration is refined. Rows are written as frames come, which bounds the
// memory.
class ResultFiles {
 public:
  // Creates the folder, removes earlier results except `config_file`, and opens the files. Throws
  // std::runtime_error with the name of a file that cannot be written; so do the other functions.
  explicit ResultFiles(const std::string& folder, const std::string& config_file = "");

  void Add(const PipelineFrame& frame);

  // Ignores an empty image. A picture that cannot be written is counted, but is no error.
  void WriteAnnotatedImage(const std::string& name, const cv::Mat& image,
                           const std::vector<int>& format = {});

  // Writes tracks/STAMP_NS.jpg: points and lines side by side at half resolution.
  void WriteTrackImage(int64_t t_ns, const cv::Mat& points, const cv::Mat& lines);

  // Completes all files and sets the map counts in `run`. `parts` are copied into summary.json by
  // name; null: none.
  void Finish(RunSummary::Run run, const Config& config, const Json& parts);

  const std::string& folder() const { return folder_; }
  const RunSummary& summary() const { return summary_; }
  const TimedFile& trajectory() const { return trajectory_; }
  const DropCount& unwritten_pictures() const { return unwritten_pictures_; }

 private:
  std::string File(const std::string& name) const;
  void AddMapPoints(const std::vector<MapPoint>& points);
  // Replaces a line that was added before, since it was re-observed.
  void AddMapLines(const std::vector<MapLine>& lines);
  // Adds the landmarks in the window to the map.
  void EndWindow();
  // Ends the world frame as well, after which ids start again.
  void EndWorld();
  void WriteLines() const;
  void WriteSummary(const RunSummary::Run& run, const Config& config, const Json& parts) const;

  std::string folder_;
  TimedFile trajectory_;
  TimedFile covariance_;
  OutputFile timing_;
  PlyPointWriter map_;
  std::vector<MapLine> lines_;              // lines of previous world frames
  std::map<int64_t, MapLine> world_lines_;  // lines of the current world frame, by id
  std::vector<MapPoint> window_points_;     // newest frame with a pose, not in the map yet
  std::vector<MapLine> window_lines_;
  RunSummary summary_;
  DropCount unwritten_pictures_{"pictures_not_written", 0, ""};
};

}  // namespace plm_vins
