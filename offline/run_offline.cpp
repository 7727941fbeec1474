// SPDX-License-Identifier: BSD-3-Clause
// Runs the odometry over a recording without a ROS master, as fast as the machine goes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/append.h"
#include "common/config/config.h"
#include "common/io/output_file.h"
#include "common/io/progress_display.h"
#include "common/process_setup.h"
#include "common/stopwatch.h"
#include "offline/pipeline/odometry_pipeline.h"
#include "offline/pipeline/tracker_values.h"
#include "offline/recordings/asl_recording.h"
#include "offline/recordings/bag_recording.h"
#include "offline/results/loop_results.h"
#include "offline/results/result_files.h"
#include "offline/results/result_folder.h"
#include "pose_graph/output/map_file.h"

namespace plm_vins {
namespace {

struct Arguments {
  std::string config;
  std::string bag;
  std::string asl;
  std::string features;
  std::string output;
  std::string saved_features;
  std::string map_in;
  std::string map_out;
  double start = 0;                                           // [s]
  double duration = std::numeric_limits<double>::infinity();  // [s]
  std::vector<std::string> overrides;                         // "key=value"
  double track_image_interval = 0;                            // [s]; 0: none
  int threads = 4;
};

constexpr double kMostSeconds = 1e9;  // stamps count nanoseconds in 64 bits

// The message of what is wrong with the argument of --set; empty where nothing is.
std::string CheckOverride(const std::string& text) {
  const size_t equals = text.find('=');
  const bool valid = equals != 0 && equals != std::string::npos;
  return valid ? "" : "expected key=value instead of " + text;
}

// The same of a time span.
std::string CheckSeconds(const std::string& text) {
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  const bool is_number = end != text.c_str() && *end == '\0';
  const bool valid = is_number && seconds >= 0 && seconds <= kMostSeconds;
  return valid ? "" : "expected seconds, zero to 1e9, instead of " + text;
}

void Declare(Arguments* arguments, CLI::App* app) {
  app->add_option("--config", arguments->config, "configuration file (VINS YAML)")->required();
  auto* source = app->add_option_group("input");
  source->add_option("--bag", arguments->bag, "ROS bag");
  source->add_option("--asl", arguments->asl, "folder in ASL format (EuRoC)");
  source->add_option("--features", arguments->features,
                     "features that --save-features wrote, instead of images");
  source->require_option(1);
  app->add_option("--output", arguments->output, "folder for the results, made where missing")
      ->required();
  app->add_option("--start", arguments->start, "skip this much after the first image [s]")
      ->check(CheckSeconds);
  app->add_option("--duration", arguments->duration, "process this much [s]")->check(CheckSeconds);
  app->add_option("--save-features", arguments->saved_features,
                  "write the tracked features to this file, for runs without images");
  app->add_option("--save-track-images", arguments->track_image_interval,
                  "write a small image with its points and lines to tracks/ every so often [s]")
      ->check(CheckSeconds);
  app->add_option("--map-in", arguments->map_in,
                  "start in this map (--map-out of another run); switches loop_closure on");
  app->add_option("--map-out", arguments->map_out,
                  "save the map to this file in the end; switches loop_closure on");
  app->add_option("--set", arguments->overrides, "replace values of the configuration: key=value")
      ->check(CheckOverride);
  app->add_option("--threads", arguments->threads,
                  "1: all in turn, 2: trackers beside the estimator, 3: and beside each other, 4: "
                  "and images read ahead; the results are the same")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
}

std::map<std::string, std::string> ParseOverrides(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> overrides;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    overrides[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return overrides;
}

std::unique_ptr<Recording> Open(const Arguments& arguments, const SensorConfig& sensor) {
  if (!arguments.asl.empty()) return OpenAslFolder(arguments.asl);
  return OpenBag(arguments.bag, sensor.image_topic, sensor.imu_topic);
}

void Warn(const std::string& text) {
  if (!text.empty()) std::fprintf(stderr, "warning: %s\n", text.c_str());
}

// What was run, as far as its source knows.
struct Source {
  std::string name;
  std::string images, imu;  // where they come from
  DropCounts problems;
};

// Where the input comes from that was dropped, as far as its cause says.
std::string Origin(const DropCount& drop, const Source& source) {
  const auto begins_with = [&](const char* word) { return drop.cause.rfind(word, 0) == 0; };
  return begins_with("image") ? source.images : begins_with("imu") ? source.imu : "";
}

void Warn(const DropCount& drop, const Source& source) {
  if (drop.count == 0) return;
  const std::string origin = Origin(drop, source);
  Warn(origin.empty() ? ToString(drop) : ToString(drop) + " from " + origin);
}

std::string WhyNone(const RunSummary::Run& run, const RunSummary& summary) {
  if (!summary.last_reason().empty()) return summary.last_reason();
  const bool dropped = std::any_of(run.drops.begin(), run.drops.end(),
                                   [](const DropCount& drop) { return drop.count > 0; });
  return dropped ? "none was usable, see the warnings" : "none between --start and --duration";
}

// The warning where most of a recording was of no use; empty where it was not.
std::string UnusedWarning(int64_t unused, int64_t images) {
  if (2 * unused <= images) return "";
  return std::to_string(unused) + " of " + std::to_string(images) + " images were not used";
}

// The warning where time does not run forward in a recording; empty where it does.
std::string PartsWarning(const TimedFile& trajectory) {
  if (trajectory.parts() == 0) return "";
  return "stamps jumped back " + std::to_string(trajectory.parts()) +
         " times: poses of before are in trajectory_1.tum, covariance_1.csv, ...";
}

// Says how it went. Exit code: 0 where there is a trajectory.
int Report(const RunSummary::Run& run, const Source& source, int64_t unused_images,
           const ResultFiles& results) {
  const RunSummary& summary = results.summary();
  for (const DropCount& drop : run.drops) Warn(drop, source);
  Warn(results.unwritten_pictures(), source);
  Warn(UnusedWarning(unused_images, run.images));
  Warn(PartsWarning(results.trajectory()));
  if (summary.poses() == 0) {
    std::fprintf(stderr, "run_offline: no trajectory from %" PRId64 " images: %s\n", run.images,
                 WhyNone(run, summary).c_str());
    return 1;
  }
  std::fprintf(stderr, "%" PRId64 " images, %" PRId64 " poses in %.1f s; results in %s\n",
               run.images, summary.poses(), run.wall_time, results.folder().c_str());
  return 0;
}

using FrameCallback = OdometryPipeline::FrameCallback;

RunSummary::Run Describe(const Source& source, const OdometryPipeline& pipeline) {
  RunSummary::Run run;
  run.input = source.name;
  run.images = pipeline.images();
  run.first_image_ns = pipeline.first_image_ns();
  run.drops = source.problems;
  Append(pipeline.drops(), &run.drops);
  return run;
}

Source RunFromImages(const Arguments& arguments, Recording* recording,
                     const FrameCallback& on_frame, OdometryPipeline* pipeline) {
  ProgressDisplay progress(recording->end_ns(), arguments.duration);
  pipeline->Run(recording, RecordingInterval(arguments.start, arguments.duration),
                arguments.threads, [&](const PipelineFrame& frame) {
                  on_frame(frame);
                  progress.Update(frame.output.t_ns);
                });
  progress.Finish();
  using Kind = RecordingEvent::Kind;
  return {recording->name(), recording->Source(Kind::kImage), recording->Source(Kind::kImu),
          recording->problems()};
}

Source RunFromFeatures(const Arguments& arguments, FeatureFileReader* features,
                       const FrameCallback& on_frame, OdometryPipeline* pipeline) {
  pipeline->Run(features, RecordingInterval(arguments.start, arguments.duration), on_frame);
  return {arguments.features, "", "", {}};
}

std::filesystem::path FullName(const std::string& path) {
  std::error_code error;  // of an empty path, which has none
  return std::filesystem::absolute(path, error).lexically_normal();
}

// By their names where they are not there yet.
bool AreOneFile(const std::string& a, const std::string& b) {
  std::error_code error;
  return std::filesystem::equivalent(a, b, error) || (!a.empty() && FullName(a) == FullName(b));
}

std::vector<std::string> InputFiles(const Arguments& arguments) {
  std::vector<std::string> files = {arguments.config, arguments.bag, arguments.features};
  if (arguments.asl.empty()) return files;
  for (const char* table : {"imu0/data.csv", "cam0/data.csv"}) {
    files.push_back(arguments.asl + "/" + table);
    files.push_back(arguments.asl + "/mav0/" + table);
  }
  return files;
}

void CheckOutput(const char* option, const std::string& output,
                 const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    if (AreOneFile(input, output)) {
      throw std::runtime_error(std::string(option) + " would overwrite the input, " + input);
    }
  }
}

// An input would be lost where an output takes its place at the end. But a map may be continued.
void CheckOutputs(const Arguments& arguments) {
  std::vector<std::string> inputs = InputFiles(arguments);
  CheckOutput("--map-out", arguments.map_out, inputs);
  inputs.push_back(arguments.map_in);
  CheckOutput("--save-features", arguments.saved_features, inputs);
  if (AreOneFile(arguments.map_out, arguments.saved_features)) {
    throw std::runtime_error("--save-features and --map-out both name " + arguments.map_out);
  }
}

// The configuration as the arguments change it.
Config Configure(const Arguments& arguments) {
  Config config = LoadConfig(arguments.config, ParseOverrides(arguments.overrides));
  PoseGraphConfig& pose_graph = config.pose_graph;
  if (!arguments.map_in.empty() || !arguments.map_out.empty()) pose_graph.loop_closure = true;
  if (pose_graph.loop_closure && !arguments.features.empty()) {
    throw std::runtime_error(
        "loop closure needs images: run it without --features, or with "
        "--set loop_closure=0");
  }
  if (arguments.track_image_interval > 0 && !arguments.features.empty()) {
    throw std::runtime_error("--save-track-images needs images: run it without --features");
  }
  return config;
}

std::optional<KeyframeMap> MapToStartIn(const Arguments& arguments, const PoseGraphConfig& config) {
  if (!arguments.map_in.empty()) return LoadMap(arguments.map_in);
  if (!config.loop_closure || !config.load_previous) return std::nullopt;
  PreviousMap previous = LoadPreviousMap(config.MapFile());
  Warn(previous.warning);
  return std::move(previous.map);
}

void ShowTracks(double interval, ResultFiles* results, OdometryPipeline* pipeline) {
  if (interval <= 0) return;
  pipeline->ShowTracks(interval,
                       [results](int64_t t_ns, const cv::Mat& points, const cv::Mat& lines) {
                         results->WriteTrackImage(t_ns, points, lines);
                       });
}

// Warns where features are not those that the configuration asks for, and tells the summary.
void CheckFeatures(const FeatureFileReader& features, const Config& config, Json* summary_parts) {
  const Json otherwise = RecordedOtherwise(features.tracker_values(), config);
  if (otherwise.empty()) return;
  Warn(RecordedOtherwiseWarning(features.file(), otherwise));
  (*summary_parts)["features_recorded_with"] = otherwise;
}

// By which the features were recorded that are saved now.
Json ValuesToSave(const std::optional<FeatureFileReader>& features, const Config& config) {
  if (!features) return TrackerValues(config);
  Json values = features->tracker_values();
  if (!config.use_lines) values["use_lines"] = false;
  return values;
}

int Run(const Arguments& arguments) {
  CheckOutputs(arguments);
  const Config config = Configure(arguments);
  for (const std::string& warning : config.warnings) Warn(warning);
  // What may be missing, or not writable, comes first: then earlier results stay as they are.
  std::unique_ptr<Recording> recording;
  std::optional<FeatureFileReader> features;
  if (arguments.features.empty()) {
    recording = Open(arguments, config.sensor);
  } else {
    features.emplace(arguments.features);
  }
  Json summary_parts = Json::object();
  if (features) CheckFeatures(*features, config, &summary_parts);
  std::optional<KeyframeMap> map = MapToStartIn(arguments, config.pose_graph);
  MakeResultFolder(arguments.output);
  std::optional<ReplacedFile> map_out;
  if (!arguments.map_out.empty()) map_out.emplace(arguments.map_out);
  OdometryPipeline pipeline(config);
  std::optional<FeatureFileWriter> saved_features;
  if (!arguments.saved_features.empty()) {
    pipeline.SaveFeatures(
        &saved_features.emplace(arguments.saved_features, ValuesToSave(features, config)));
  }
  ResultFiles results(arguments.output, arguments.config);
  ShowTracks(arguments.track_image_interval, &results, &pipeline);
  std::optional<LoopResults> loops;
  if (config.pose_graph.loop_closure) loops.emplace(config, arguments.output, std::move(map));
  const auto on_frame = [&](const PipelineFrame& frame) {
    results.Add(frame);
    if (loops) loops->Add(frame);
  };
  const Stopwatch stopwatch;
  const Source source = features ? RunFromFeatures(arguments, &*features, on_frame, &pipeline)
                                 : RunFromImages(arguments, recording.get(), on_frame, &pipeline);
  RunSummary::Run run = Describe(source, pipeline);
  run.wall_time = 1e-3 * stopwatch.Milliseconds();
  Warn(pipeline.imu_contradiction());
  // What may be on another disk comes first, and the summary, which says that all is there, last.
  if (saved_features) saved_features->Close();
  if (map_out && loops->map().CountKept() > 0) {
    SaveMap(loops->map(), &*map_out);
  } else if (map_out) {
    Warn("there is no keyframe, so --map-out " + arguments.map_out + " is not written");
  }
  if (loops) loops->Finish();
  results.WriteAnnotatedImage("tracks.png", pipeline.points_image());
  results.WriteAnnotatedImage("line_tracks.png", pipeline.lines_image());
  if (loops) summary_parts["loops"] = loops->Summary();
  results.Finish(run, config, summary_parts);
  return Report(run, source, pipeline.unused_images(), results);
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) try {
  CLI::App app("Visual-inertial odometry over a recording");
  plm_vins::Arguments arguments;
  plm_vins::Declare(&arguments, &app);
  try {
    app.parse(argc, argv);
    plm_vins::SetUpProcess();
    return plm_vins::Run(arguments);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "run_offline: %s (--help lists the options)\n", error.what());
  } catch (const plm_vins::ConfigError& error) {
    for (const std::string& problem : error.problems()) {
      std::fprintf(stderr, "run_offline: %s\n", problem.c_str());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "run_offline: %s\n", error.what());
  }
  return 1;
} catch (...) {  // of the handlers above
  return 1;
}
