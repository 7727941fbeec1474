// SPDX-License-Identifier: BSD-3-Clause
// Renders a flight through a simulated world: images, IMU samples and exact ground truth.
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "common/config/config.h"
#include "common/format.h"
#include "common/io/command_line.h"
#include "common/io/progress_display.h"
#include "simulator/recording/asl_recorder.h"
#include "simulator/recording/flight.h"
#include "simulator/recording/ground_truth.h"
#include "simulator/recording/recorder.h"

namespace plm_vins::simulator {
namespace {

struct Arguments {
  std::string output;
  std::string asl;
  std::string config;
  std::string rig;
  bool stereo = false;
  bool depth = false;
  FlightOptions flight;
};

template <typename T>
TakeValue TakeChoice(const std::map<std::string, T>& choices, T* value) {
  return [=](const std::string& text) -> std::string {
    const auto choice = choices.find(text);
    if (choice != choices.end()) *value = choice->second;
    if (choice != choices.end()) return "";
    std::string names;
    for (const auto& [name, unused] : choices) names += (names.empty() ? "" : ", ") + name;
    return "expected one of " + names + " instead of " + text;
  };
}

TakeValue TakeBag(std::string* file) {
  return [file](const std::string& text) -> std::string {
    const std::string extension = std::filesystem::path(text).extension().string();
    if (extension == ".tum" || extension == ".csv") {
      return "expected a bag; the ground truth would overwrite " + text;
    }
    return TakePath(file)(text);
  };
}

TakeValue TakeSeed(uint64_t* seed) {
  return [seed](const std::string& text) -> std::string {
    const auto end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, *seed);
    const bool valid = error == std::errc() && stop == end;
    return valid ? "" : "expected a whole number of at least 0 instead of " + text;
  };
}

void DeclareFiles(Arguments* arguments, CommandLine* line) {
  line->Add("output", TakeBag(&arguments->output),
            "ROS bag, new; the ground truth goes beside it as .tum and .csv");
  line->Add("asl", TakePath(&arguments->asl), "folder in ASL format (EuRoC), new");
  line->Add("config", TakePath(&arguments->config),
            "sensors: topics, camera 0, shutter, extrinsics, IMU noise, td (default: EuRoC's)");
  line->Add("rig", TakePath(&arguments->rig), "sensors likewise, but with all cameras of the file");
  line->AddFlag("stereo", &arguments->stereo, "all cameras of --config, as --rig");
  line->AddFlag("depth", &arguments->depth, "depth images as the configuration has them, too");
}

void DeclareFlight(FlightOptions* flight, CommandLine* line) {
  line->Add("world",
            TakeChoice<WorldKind>({{"room", WorldKind::kRoom},
                                   {"corridor", WorldKind::kCorridor},
                                   {"twins", WorldKind::kTwins},
                                   {"irregular", WorldKind::kIrregular}},
                                  &flight->world),
            "where to fly: room (default), corridor, irregular: a room without right angles, "
            "twins: two equal rooms");
  line->Add("texture",
            TakeChoice<TextureStyle>({{"rich", TextureStyle::kRich}, {"weak", TextureStyle::kWeak}},
                                     &flight->texture),
            "rich (default), or weak: almost only lines");
  line->Add("motion",
            TakeChoice<Motion>({{"gentle", Motion::kGentle},
                                {"fast", Motion::kFast},
                                {"hover", Motion::kHover},
                                {"rotation", Motion::kPureRotation},
                                {"straight", Motion::kCorridor},
                                {"still", Motion::kStill}},
                               &flight->motion),
            "how to fly: gentle (default), fast, hover, rotation, straight, still");
  line->Add("duration", TakeNumber(2, 3600, &flight->duration),
            Format("length of the flight, 2 to 3600 (default %g) [s]", flight->duration));
  line->Add("frame-rate", TakeNumber(1, 200, &flight->frame_rate_hz),
            Format("images per second, 1 to 200 (default %g) [Hz]", flight->frame_rate_hz));
  line->Add("exposure", TakeNumber(0, 0.05, &flight->imaging.exposure),
            Format("of an image, 0 to 0.05 (default %g) [s]", flight->imaging.exposure));
  line->Add("seed", TakeSeed(&flight->seed),
            "same seed, same recording (default " + std::to_string(flight->seed) + ")");
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
    throw std::runtime_error(file + " already exists; remove it or choose another");
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

SensorConfig ChooseSensors(const Arguments& arguments) {
  if (!arguments.rig.empty() && !arguments.config.empty()) {
    throw std::runtime_error("--rig: gives all sensors; remove --config");
  }
  const std::string& file = arguments.rig.empty() ? arguments.config : arguments.rig;
  SensorConfig sensors = file.empty() ? DefaultSensors() : LoadConfig(file).sensor;
  if (arguments.depth && !sensors.depth) {
    throw std::runtime_error("--depth: name a configuration with depth_topic");
  }
  if (arguments.rig.empty() && !arguments.stereo) sensors.cameras.resize(1);
  if (!arguments.depth) sensors.depth.reset();
  return sensors;
}

void Run(Arguments arguments) {
  if (arguments.output.empty() && arguments.asl.empty()) {
    throw std::runtime_error("--output or --asl is required");
  }
  FlightOptions& options = arguments.flight;
  options.sensors = ChooseSensors(arguments);
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
  try {
    plm_vins::CommandLine command_line("Renders a flight through a simulated world");
    plm_vins::simulator::Arguments arguments;
    plm_vins::simulator::DeclareFiles(&arguments, &command_line);
    plm_vins::simulator::DeclareFlight(&arguments.flight, &command_line);
    if (!command_line.Parse(argc, argv)) return 0;
    plm_vins::simulator::Run(arguments);
    return 0;
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
