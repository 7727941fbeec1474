// SPDX-License-Identifier: BSD-3-Clause
// Renders a flight through a simulated world: images, IMU samples and exact ground truth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/format.h"
#include "common/io/option_checks.h"
#include "common/io/progress_display.h"
#include "simulator/recording/asl_recorder.h"
#include "simulator/recording/bag_recorder.h"
#include "simulator/recording/flight.h"
#include "simulator/recording/ground_truth.h"

namespace plm_vins::simulator {
namespace {

struct Arguments {
  std::string output;
  std::string asl;
  std::string config;
  bool stereo = false;
  bool depth = false;
  FlightOptions flight;
};

template <typename T>
void AddChoice(CLI::App* app, const std::string& name, T* value, const std::string& help,
               const std::map<std::string, T>& choices) {
  app->add_option_function<std::string>(
         name, [=](const std::string& choice) { *value = choices.at(choice); }, help)
      ->check(CLI::IsMember(choices));
}

// Validates the argument of --output; returns an error message, or an empty string if it is valid.
std::string CheckBag(const std::string& file) {
  if (file.empty()) return CheckPath(file);
  const std::string extension = std::filesystem::path(file).extension().string();
  const bool is_truth = extension == ".tum" || extension == ".csv";
  return is_truth ? "expected a bag instead of " + file + ", where the ground truth is to go" : "";
}

// Validates a number in a range. CLI::Range would accept "nan".
std::function<std::string(const std::string&)> Between(double least, double most) {
  return [=](const std::string& text) {
    const bool valid = IsNumberBetween(least, most, text);
    return valid ? "" : Format("expected %g to %g instead of ", least, most) + text;
  };
}

// Validates a seed. CLI would accept "-1", as the largest unsigned number.
std::string CheckSeed(const std::string& text) {
  const bool valid = std::all_of(text.begin(), text.end(),
                                 [](unsigned char digit) { return std::isdigit(digit) != 0; });
  return valid ? "" : "expected a whole number, zero or more, instead of " + text;
}

void Declare(Arguments* arguments, CLI::App* app) {
  FlightOptions& flight = arguments->flight;
  auto* output = app->add_option_group("output");
  output
      ->add_option("--output", arguments->output,
                   "ROS bag, new; the ground truth goes beside it as .tum and .csv")
      ->check(CheckBag);
  output->add_option("--asl", arguments->asl, "folder in ASL format (EuRoC), new")
      ->check(CheckPath);
  output->require_option(1, 2);
  app->add_option("--config", arguments->config,
                  "sensors: topics, camera, shutter, extrinsics, IMU noise, td (default: EuRoC's)")
      ->check(CheckPath);
  app->add_flag("--stereo", arguments->stereo, "the configuration's second camera, too");
  app->add_flag("--depth", arguments->depth, "depth images as the configuration has them, too");
  AddChoice<WorldKind>(app, "--world", &flight.world,
                       "where to fly; atlanta: a room of two frames, irregular: one without, "
                       "twins: two equal rooms, "
                       "shelves: rows of equal ones, tiles: a room of equal tiles (default: room)",
                       {{"room", WorldKind::kRoom},
                        {"corridor", WorldKind::kCorridor},
                        {"hall", WorldKind::kHall},
                        {"atlanta", WorldKind::kAtlanta},
                        {"twins", WorldKind::kTwins},
                        {"shelves", WorldKind::kShelves},
                        {"tiles", WorldKind::kTiles},
                        {"irregular", WorldKind::kIrregular}});
  AddChoice<TextureStyle>(app, "--texture", &flight.texture,
                          "weak leaves almost only lines (default: rich)",
                          {{"rich", TextureStyle::kRich}, {"weak", TextureStyle::kWeak}});
  AddChoice<Motion>(app, "--motion", &flight.motion, "how to fly (default: gentle)",
                    {{"gentle", Motion::kGentle},
                     {"fast", Motion::kFast},
                     {"hover", Motion::kHover},
                     {"rotation", Motion::kPureRotation},
                     {"straight", Motion::kCorridor},
                     {"still", Motion::kStill}});
  app->add_option("--duration", flight.duration, "length of the flight, 2 to 3600 [s]")
      ->check(Between(2, 3600))
      ->capture_default_str();
  app->add_option("--frame-rate", flight.frame_rate_hz, "images per second, 1 to 200 [Hz]")
      ->check(Between(1, 200))
      ->capture_default_str();
  app->add_option("--exposure", flight.imaging.exposure, "of an image, 0 to 0.05 [s]")
      ->check(Between(0, 0.05))
      ->capture_default_str();
  app->add_option("--seed", flight.seed, "same seed, same recording")
      ->check(CheckSeed)
      ->capture_default_str();
}

struct TruthFiles {
  std::string tum, csv;
};

TruthFiles TruthBeside(const std::string& bag) {
  const std::filesystem::path path = bag;
  return {std::filesystem::path(path).replace_extension(".tum").string(),
          std::filesystem::path(path).replace_extension(".csv").string()};
}

// The name may be that of a recording of real data, so existing files are not overwritten.
void RefuseToReplace(const std::string& bag) {
  const TruthFiles truth = TruthBeside(bag);
  for (const std::string& file : {bag, truth.tum, truth.csv}) {
    if (!std::filesystem::exists(file)) continue;
    throw std::runtime_error(file + " is there already: remove it or choose another");
  }
}

std::vector<std::unique_ptr<Recorder>> OpenRecorders(const Arguments& arguments) {
  std::vector<std::unique_ptr<Recorder>> recorders;
  // Tested first: an ASL folder that has been created would be rejected at the next attempt.
  const auto is_in_folder = [](const std::string& file) {
    return std::filesystem::is_directory(std::filesystem::absolute(file).parent_path());
  };
  if (!arguments.output.empty() && !is_in_folder(arguments.output)) {
    throw std::runtime_error("cannot write " + arguments.output + ": no such folder");
  }
  if (!arguments.output.empty()) RefuseToReplace(arguments.output);
  if (!arguments.asl.empty()) recorders.push_back(std::make_unique<AslRecorder>(arguments.asl));
  if (!arguments.output.empty()) {
    recorders.push_back(MakeBagRecorder(arguments.output, arguments.flight.sensors));
  }
  return recorders;
}

void WriteGroundTruth(const Arguments& arguments, const std::vector<FrameState>& states) {
  if (!arguments.output.empty()) {
    const TruthFiles files = TruthBeside(arguments.output);
    WriteTum(files.tum, states);
    WriteEurocCsv(files.csv, states);
  }
  if (!arguments.asl.empty()) {
    WriteEurocCsv(AslRecorder::GroundTruthFile(arguments.asl), states);
    WriteTum(arguments.asl + "/groundtruth.tum", states);
  }
}

// Leaves those sensors that are asked for; the configuration must have them.
void ChooseSensors(const Arguments& arguments, SensorConfig* sensors) {
  if (arguments.stereo && !sensors->second_camera) {
    throw std::runtime_error("--stereo: set num_of_cam: 2 in a configuration, and name it");
  }
  if (arguments.depth && !sensors->depth) {
    throw std::runtime_error("--depth: set depth_topic in a configuration, and name it");
  }
  if (!arguments.stereo) sensors->second_camera.reset();
  if (!arguments.depth) sensors->depth.reset();
}

void Run(Arguments arguments) {
  FlightOptions& options = arguments.flight;
  if (!arguments.config.empty()) options.sensors = LoadConfig(arguments.config).sensor;
  ChooseSensors(arguments, &options.sensors);
  const Flight flight(options);  // first, since it may throw; no folder is created then
  const auto owned = OpenRecorders(arguments);
  std::vector<Recorder*> recorders;
  recorders.reserve(owned.size());
  for (const auto& recorder : owned) recorders.push_back(recorder.get());

  WriteGroundTruth(arguments, flight.GroundTruth());
  ProgressDisplay progress(flight.imu().samples.back().t_ns);
  flight.Record(recorders, [&](int64_t t_ns) { progress.Update(t_ns); });
  progress.Finish();
}

}  // namespace
}  // namespace plm_vins::simulator

int main(int argc, char** argv) try {
  CLI::App app("Renders a flight through a simulated world");
  plm_vins::simulator::Arguments arguments;
  plm_vins::simulator::Declare(&arguments, &app);
  try {
    app.parse(argc, argv);
    plm_vins::simulator::Run(arguments);
    return 0;
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "simulate: %s (--help lists the options)\n", error.what());
  } catch (const plm_vins::ConfigError& error) {
    for (const std::string& problem : error.problems()) {
      std::fprintf(stderr, "simulate: %s\n", problem.c_str());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simulate: %s\n", error.what());
  }
  return 1;
} catch (...) {  // an exception of the handlers above
  return 1;
}
