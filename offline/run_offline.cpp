// SPDX-License-Identifier: BSD-3-Clause
// Runs the odometry over a recording without a ROS master, as fast as possible.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/append.h"
#include "common/config/config.h"
#include "common/format.h"
#include "common/io/output_file.h"
#include "common/io/progress_display.h"
#include "common/process_setup.h"
#include "common/stopwatch.h"
#include "offline/arguments.h"
#include "offline/interruption.h"
#include "offline/output_checks.h"
#include "offline/pipeline/odometry_pipeline.h"
#include "offline/pipeline/tracker_values.h"
#include "offline/recordings/asl_recording.h"
#include "offline/recordings/bag_files.h"
#include "offline/recordings/bag_recording.h"
#include "offline/report.h"
#include "offline/results/loop_results.h"
#include "offline/results/result_files.h"
#include "offline/results/result_folder.h"
#include "pose_graph/output/map_file.h"

namespace plm_vins {
namespace {

// Source of the features: exactly one of the two members is set.
struct Input {
  std::unique_ptr<Recording> recording;
  std::optional<FeatureFileReader> features;
};

Input Open(const Arguments& arguments, const SensorConfig& sensor) {
  Input input;
  if (!arguments.features.empty()) {
    input.features.emplace(arguments.features);
  } else if (!arguments.asl.empty()) {
    input.recording = OpenAslFolder(arguments.asl, static_cast<int>(sensor.cameras.size()),
                                    sensor.depth.has_value());
  } else {
    std::vector<std::string> image_topics;
    for (const CameraSensor& camera : sensor.cameras) image_topics.push_back(camera.image_topic);
    input.recording = OpenBags(arguments.bags, image_topics, sensor.imu_topic,
                               sensor.depth ? sensor.depth->topic : "");
  }
  return input;
}

using FrameCallback = OdometryPipeline::FrameCallback;

RunSummary::Run Describe(const Source& source, const OdometryPipeline& pipeline) {
  RunSummary::Run run;
  run.input = source.name;
  run.images = pipeline.images();
  run.first_image_ns = pipeline.first_image_ns();
  run.residual_rings = pipeline.residual_rings();
  run.findings = pipeline.Findings();
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

// Loads the configuration and applies the arguments to it.
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

// Warns, and notes in the summary, if features were recorded with another configuration.
void CheckFeatures(const FeatureFileReader& features, const Config& config, Json* summary_parts) {
  const Json otherwise = RecordedOtherwise(features.tracker_values(), config);
  if (otherwise.empty()) return;
  Warn(RecordedOtherwiseWarning(features.file(), otherwise));
  (*summary_parts)["features_recorded_with"] = otherwise;
}

// Returns the configuration that the saved features were tracked with.
Json ValuesToSave(const std::optional<FeatureFileReader>& features, const Config& config) {
  if (!features) return TrackerValues(config);
  Json values = features->tracker_values();
  if (!config.use_lines) values["use_lines"] = false;
  return values;
}

// All outputs of a run.
struct Outputs {
  std::optional<ReplacedFile> map;
  std::optional<FeatureFileWriter> features;
  ResultFiles results;
  RunReport report;
  std::optional<LoopResults> loops;

  // Outputs that may not be writable are opened first, so that failure leaves earlier results
  // unchanged.
  Outputs(const Arguments& arguments, const Config& config,
          const std::optional<FeatureFileReader>& input, std::optional<KeyframeMap> start)
      : map(MapFile(arguments)),
        features(FeatureFile(arguments, config, input)),
        results(arguments.output, arguments.config) {
    if (config.pose_graph.loop_closure) loops.emplace(config, arguments.output, std::move(start));
  }

  void Add(const PipelineFrame& frame) {
    results.Add(frame);
    report.Add(frame.output);
    if (loops) loops->Add(frame);
  }

 private:
  static std::optional<ReplacedFile> MapFile(const Arguments& arguments) {
    MakeResultFolder(arguments.output);
    if (arguments.map_out.empty()) return std::nullopt;
    return std::optional<ReplacedFile>(std::in_place, arguments.map_out);
  }

  static std::optional<FeatureFileWriter> FeatureFile(
      const Arguments& arguments, const Config& config,
      const std::optional<FeatureFileReader>& input) {
    if (arguments.saved_features.empty()) return std::nullopt;
    return std::optional<FeatureFileWriter>(std::in_place, arguments.saved_features,
                                            ValuesToSave(input, config));
  }
};

void SaveMapTo(const std::string& path, const KeyframeMap& map, ReplacedFile* file) {
  if (map.CountKept() > 0) {
    SaveMap(map, file);
  } else {
    Warn("there is no keyframe, so --map-out " + path + " is not written");
  }
}

// Runs `save` and appends its error to `failures`, so that the other results of the run are still
// saved.
void Try(const std::function<void()>& save, std::string* failures) {
  try {
    save();
  } catch (const std::exception& error) {
    *failures += (failures->empty() ? "" : "; ") + std::string(error.what());
  }
}

// Parts of the run that a signal interrupted.
struct Cuts {
  bool recording = false;
  bool adjustment = false;
};

void AdjustMap(LoopResults* loops, Cuts* cuts) {
  const size_t keyframes = loops->KeyframesToAdjust();
  if (keyframes == 0) return;
  std::fprintf(stderr, "adjusting the map of %zu keyframes\n", keyframes);
  const MapBundleSummary adjusted = loops->AdjustMap([] { return Interruption() != 0; });
  cuts->adjustment = adjusted.ended;
  if (!adjusted.failed) return;
  Warn(adjusted.rounds == 0
           ? "the bundle adjustment has no solution; the map keeps the poses of the pose graph"
           : "a round of the bundle adjustment failed; the map is that of the round before");
}

// Returns the exit code of a shell for a program terminated by this signal.
int ReportInterruption(const OdometryPipeline& pipeline, const Cuts& cuts) {
  if (cuts.recording) {
    const auto first_ns = pipeline.first_image_ns(), last_ns = pipeline.last_frame_ns();
    const double seconds = first_ns && last_ns ? ToSeconds(*last_ns - *first_ns) : 0;
    std::fprintf(stderr, "run_offline: interrupted at %.1f s\n", seconds);
  } else {
    std::fprintf(stderr, "run_offline: interrupted while the map was adjusted\n");
  }
  return 128 + Interruption();
}

// A run over the recording from its first image on.
struct Flight {
  Input input;
  std::unique_ptr<OdometryPipeline> pipeline;
  Outputs outputs;
  Source source;

  // Inputs that may be missing are opened first, so that failure leaves earlier results unchanged.
  Flight(const Arguments& arguments, const Config& config)
      : input(Open(arguments, config.sensor)),
        pipeline(std::make_unique<OdometryPipeline>(config)),
        outputs(arguments, config, input.features, MapToStartIn(arguments, config.pose_graph)) {}

  void Estimate(const Arguments& arguments, Cuts* cuts) {
    const auto on_frame = [this](const PipelineFrame& frame) { outputs.Add(frame); };
    if (outputs.features) pipeline->SaveFeatures(&*outputs.features);
    ShowTracks(arguments.track_image_interval, &outputs.results, pipeline.get());
    WatchForInterruption();
    pipeline->EndWhere([cuts] { return cuts->recording = Interruption() != 0; });
    source = input.features
                 ? RunFromFeatures(arguments, &*input.features, on_frame, pipeline.get())
                 : RunFromImages(arguments, input.recording.get(), on_frame, pipeline.get());
  }
};

// Flies from the first image on, and again if something is found that must be ignored, so that no
// result depends on it.
std::unique_ptr<Flight> Fly(const Arguments& arguments, const Config& config, Cuts* cuts) {
  std::unique_ptr<OdometryPipeline> earlier;
  while (true) {
    auto flight = std::make_unique<Flight>(arguments, config);
    if (earlier) flight->pipeline->LearnFrom(*earlier);
    flight->Estimate(arguments, cuts);
    if (!flight->pipeline->must_repeat() || cuts->recording) return flight;
    std::fprintf(stderr,
                 "beginning again: the input is worse than stated, see the warnings below\n");
    earlier = std::move(flight->pipeline);
  }
}

// Completes the files in the result folder; the summary, which marks them as complete, comes last.
void Finish(const RunSummary::Run& run, const Config& config, const OdometryPipeline& pipeline,
            Json summary_parts, Outputs* outputs) {
  if (outputs->loops) {
    outputs->loops->Finish();
    summary_parts["loops"] = outputs->loops->Summary();
  }
  outputs->results.WriteAnnotatedImage("tracks.png", pipeline.points_image());
  outputs->results.WriteAnnotatedImage("line_tracks.png", pipeline.lines_image());
  outputs->results.Finish(run, config, summary_parts);
}

int Run(const Arguments& arguments) {
  CheckOutputs(arguments);
  const Config config = Configure(arguments);
  CheckCalibrationOutput(arguments, config.sensor);
  for (const std::string& warning : config.warnings) Warn(warning);
  const Stopwatch stopwatch;
  Cuts cuts;
  const std::unique_ptr<Flight> flight = Fly(arguments, config, &cuts);
  const OdometryPipeline& pipeline = *flight->pipeline;
  Outputs& outputs = flight->outputs;
  Json summary_parts = Json::object();
  if (flight->input.features) CheckFeatures(*flight->input.features, config, &summary_parts);
  RunSummary::Run run = Describe(flight->source, pipeline);
  run.wall_time = 1e-3 * stopwatch.Milliseconds();
  // Outputs that may be on another disk or take long are saved before the rest.
  std::string failures;
  if (outputs.features) Try([&] { outputs.features->Close(); }, &failures);
  if (outputs.loops && !cuts.recording) Try([&] { AdjustMap(&*outputs.loops, &cuts); }, &failures);
  if (outputs.loops) {
    std::fprintf(stderr, "%s\n", outputs.loops->Line().c_str());
    const std::string finding = outputs.loops->Finding();
    if (!finding.empty()) run.findings.push_back(finding);
  }
  if (outputs.map) {
    Try([&] { SaveMapTo(arguments.map_out, outputs.loops->map(), &*outputs.map); }, &failures);
  }
  if (const auto last_ns = pipeline.last_image_ns()) outputs.report.End(*last_ns);
  int exit_code = 1;
  const auto finish = [&] {
    Finish(run, config, pipeline, summary_parts, &outputs);
    exit_code = Report(run, flight->source, pipeline, outputs.report, outputs.results);
  };
  Try(finish, &failures);
  if (!failures.empty()) throw std::runtime_error(failures);
  return cuts.recording || cuts.adjustment ? ReportInterruption(pipeline, cuts) : exit_code;
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) try {
  try {
    plm_vins::CommandLine command_line("Visual-inertial odometry over a recording");
    plm_vins::Arguments arguments;
    plm_vins::Declare(&arguments, &command_line);
    if (!command_line.Parse(argc, argv)) return 0;
    plm_vins::CheckPresence(arguments);
    arguments.bags = plm_vins::FindBags(arguments.bags);
    plm_vins::SetUpProcess();
    return plm_vins::Run(arguments);
  } catch (const plm_vins::ConfigError& error) {
    for (const std::string& problem : error.problems()) {
      std::fprintf(stderr, "run_offline: %s\n", problem.c_str());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "run_offline: %s\n", error.what());
  }
  return 1;
} catch (...) {  // an exception of the handlers above
  return 1;
}
