// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/result_files.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>
#include <utility>

#include "offline/results/frame_columns.h"
#include "offline/results/result_folder.h"
#include "vins_estimator/output/calibrated_config.h"
#include "vins_estimator/output/config_json.h"
#include "vins_estimator/output/pose_rows.h"

namespace plm_vins {
namespace {

namespace fs = std::filesystem;

constexpr int kTrackImageQuality = 70;  // JPEG; a few ten kB for each image

// Returns the landmarks that stay in the window. Departed ones are reported with the frame that
// removes them.
template <typename Landmark>
std::vector<Landmark> Staying(const std::vector<Landmark>& in_window,
                              const std::vector<Landmark>& departed) {
  std::vector<Landmark> staying;
  std::copy_if(in_window.begin(), in_window.end(), std::back_inserter(staying),
               [&](const Landmark& landmark) {
                 return std::none_of(departed.begin(), departed.end(),
                                     [&](const Landmark& gone) { return gone.id == landmark.id; });
               });
  return staying;
}

// Replaces invalid UTF-8 in paths, so that the summary can be written.
std::string ToText(const Json& json) {
  return json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

bool WritePicture(const std::string& file, const cv::Mat& image, const std::vector<int>& format) {
  try {
    return cv::imwrite(file, image, format);
  } catch (const cv::Exception&) {
    return false;
  }
}

std::string Prepared(const std::string& folder, const std::string& config_file) {
  MakeResultFolder(folder);
  RemoveEarlierResults(folder, config_file);
  return folder;
}

}  // namespace

ResultFiles::ResultFiles(const std::string& folder, const std::string& config_file)
    : folder_(Prepared(folder, config_file)),
      trajectory_(File("trajectory.tum")),
      covariance_(File("covariance.csv"), CovarianceHeader()),
      timing_(File("timing.csv")),
      map_(File("map.ply")),
      summary_(ColumnsOf(PipelineFrame())) {
  WriteFrameHeader(ColumnsOf(PipelineFrame()), &timing_.stream());
}

std::string ResultFiles::File(const std::string& name) const {
  return (fs::path(folder_) / name).string();
}

void ResultFiles::Add(const PipelineFrame& frame) {
  const EstimatorOutput& output = frame.output;
  const FrameColumns columns = ColumnsOf(frame);
  WriteFrameRow(output.t_ns, columns, &timing_.stream());
  summary_.Add(output, columns);
  if (output.restarted) {
    trajectory_.Comment(FormatTumRestart(output.reason));
    EndWorld();
  }
  if (output.status == EstimatorStatus::kLost) EndWindow();
  AddMapPoints(output.departed_points);
  AddMapLines(output.departed_lines);
  for (const int64_t id : output.absorbed_lines) world_lines_.erase(id);
  if (!output.has_pose) return;
  trajectory_.Row(output.t_ns) << FormatTumRow(output.t_ns, output.state.T_W_B());
  if (output.uncertainty) {
    WriteCovarianceRow(output.t_ns, output.uncertainty->pose, &covariance_.Row(output.t_ns));
  }
  window_points_ = Staying(output.points, output.departed_points);
  window_lines_ = Staying(output.lines, output.departed_lines);
}

void ResultFiles::AddMapPoints(const std::vector<MapPoint>& points) {
  for (const MapPoint& point : points) map_.Add(point.p_W);
}

void ResultFiles::AddMapLines(const std::vector<MapLine>& lines) {
  for (const MapLine& line : lines) world_lines_[line.id] = line;
}

void ResultFiles::EndWindow() {
  AddMapPoints(window_points_);
  AddMapLines(window_lines_);
  window_points_.clear();
  window_lines_.clear();
}

void ResultFiles::EndWorld() {
  EndWindow();
  for (const auto& [id, line] : world_lines_) lines_.push_back(line);
  world_lines_.clear();
}

void ResultFiles::WriteAnnotatedImage(const std::string& name, const cv::Mat& image,
                                      const std::vector<int>& format) {
  if (!image.empty() && !WritePicture(File(name), image, format)) {
    unwritten_pictures_.Add(File(name));
  }
}

void ResultFiles::WriteTrackImage(int64_t t_ns, const cv::Mat& points, const cv::Mat& lines) {
  if (points.empty()) return;
  cv::Mat image = points;
  if (!lines.empty()) cv::hconcat(points, lines, image);
  cv::resize(image, image, {}, 0.5, 0.5, cv::INTER_AREA);
  std::error_code error;  // an error is reported when the picture is written
  fs::create_directories(File(kTrackImages), error);
  WriteAnnotatedImage(fs::path(kTrackImages) / (std::to_string(t_ns) + ".jpg"), image,
                      {cv::IMWRITE_JPEG_QUALITY, kTrackImageQuality});
}

void ResultFiles::Finish(RunSummary::Run run, const Config& config, const Json& parts) {
  EndWorld();
  map_.Finish();
  trajectory_.Close();
  covariance_.Close();
  timing_.Close();
  WriteLines();
  run.map_points = map_.size();
  run.map_lines = static_cast<int64_t>(lines_.size());
  if (summary_.poses() > 0 && RefinesCalibration(config.sensor)) {
    SaveCalibratedConfig(summary_.calibration(), config, File(kCalibratedConfigFile));
  }
  WriteSummary(run, config, parts);  // last: it marks the results as complete
}

void ResultFiles::WriteLines() const {
  OutputFile ply(File("lines.ply"));
  WriteSegmentsPly(lines_, &ply.stream());
  ply.Close();
  OutputFile obj(File("lines.obj"));
  WriteSegmentsObj(lines_, &obj.stream());
  obj.Close();
}

void ResultFiles::WriteSummary(const RunSummary::Run& run, const Config& config,
                               const Json& parts) const {
  Json summary = summary_.ToJson(run);
  for (const auto& [name, part] : parts.items()) summary[name] = part;
  summary["version"] = PLM_VINS_VERSION;
  summary["config"] = ToJson(config);
  ReplacedFile file(File("summary.json"));
  file.stream() << ToText(summary);
  file.Commit();
}

}  // namespace plm_vins
