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

// Results of an offline run in their folder: trajectory.tum, covariance.csv, timing.csv,
// summary.json, map.ply, lines.ply, lines.obj, tracks.png, line_tracks.png, tracks/, and
// calibrated.yaml where the calibration is refined. Rows are written as frames come, which keeps
// memory small.
class ResultFiles {
 public:
  // Makes the folder, removes earlier results from it, but for `config_file`, and opens the files.
  // What cannot be written, here or later, throws std::runtime_error that names it.
  explicit ResultFiles(const std::string& folder, const std::string& config_file = "");

  void Add(const PipelineFrame& frame);

  // Nothing where the image is empty. A picture that cannot be written is counted, and no error.
  void WriteAnnotatedImage(const std::string& name, const cv::Mat& image,
                           const std::vector<int>& format = {});

  // tracks/STAMP_NS.jpg: points and lines side by side, in half the size.
  void WriteTrackImage(int64_t t_ns, const cv::Mat& points, const cv::Mat& lines);

  // Completes all files; the counts of the map in `run` are filled in here. `parts` go into
  // summary.json as they are, by name; null: there are none.
  void Finish(RunSummary::Run run, const Config& config, const Json& parts);

  const std::string& folder() const { return folder_; }
  const RunSummary& summary() const { return summary_; }
  const TimedFile& trajectory() const { return trajectory_; }
  const DropCount& unwritten_pictures() const { return unwritten_pictures_; }

 private:
  std::string File(const std::string& name) const;
  void AddMapPoints(const std::vector<MapPoint>& points);
  // A line that is there already, since it came back into view, is replaced.
  void AddMapLines(const std::vector<MapLine>& lines);
  // The landmarks in the window go into the map.
  void EndWindow();
  // ... and ids start over.
  void EndWorld();
  void WriteLines() const;
  void WriteSummary(const RunSummary::Run& run, const Config& config, const Json& parts) const;

  std::string folder_;
  TimedFile trajectory_;
  TimedFile covariance_;
  OutputFile timing_;
  PlyPointWriter map_;
  std::vector<MapLine> lines_;              // of world frames that have ended
  std::map<int64_t, MapLine> world_lines_;  // of this one, by id
  std::vector<MapPoint> window_points_;     // of the newest frame with a pose: not in the map yet
  std::vector<MapLine> window_lines_;
  RunSummary summary_;
  DropCount unwritten_pictures_{"pictures_not_written", 0, ""};
};

}  // namespace plm_vins
