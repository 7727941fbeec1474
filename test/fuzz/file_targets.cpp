// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "common/config/config.h"
#include "offline/recordings/asl_recording.h"
#include "pose_graph/loop_closer.h"
#include "pose_graph/output/map_file.h"
#include "test/fuzz/target.h"
#include "test/pose_graph/map_checksum.h"
#include "test/pose_graph/two_visits.h"

namespace plm_vins::fuzz {
namespace {

namespace fs = std::filesystem;

// Folder of this process; it remains if the target crashes.
fs::path Folder() {
  fs::path folder = fs::temp_directory_path() / ("plm_vins_fuzz_" + std::to_string(getpid()));
  fs::create_directories(folder);
  return folder;
}

void Write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

Bytes ReadFile(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return ToBytes(text.str());
}

std::string ImuCsv() {
  std::string text = "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
  for (int i = 0; i < 40; ++i) {
    text += std::to_string(1403636579758555392 + 5'000'000 * i) + ",0.1,-0.2,0.03,8.1,-0.4,5e-1\n";
  }
  return text;
}

std::string ImagesCsv() {
  std::string text = "#timestamp [ns],filename\n";
  for (int i = 0; i < 4; ++i) {
    const std::string stamp = std::to_string(1403636579758555392 + 50'000'000 * i);
    text.append(stamp).append(",").append(stamp).append(".png\n");
  }
  return text;
}

constexpr size_t kMapHeader = 33;  // signature, version, size and checksum of what follows

// A part of a flight along a wall in the odometry world `world`.
std::vector<Keyframe> FlightAlongAWall(const CameraModel& camera, int world, int64_t start_ns) {
  std::vector<Keyframe> keyframes;
  for (int i = 0; i < 4; ++i) {
    testing::VisitOptions options;
    options.world = world;
    options.first_track = int64_t{1000} * world;
    const Rigid3d T_W_B(Eigen::Quaterniond::Identity(), {0, 0.3 * i, 0});
    const int64_t t_ns = start_ns + i * int64_t{1'000'000'000};
    keyframes.push_back(testing::Visit(testing::Wall(1, 60), camera, T_W_B, t_ns, options));
  }
  return keyframes;
}

Bytes SavedMap(const CameraModel& camera) {
  KeyframeMap map;
  map.keyframes = FlightAlongAWall(camera, 0, 0);
  for (const Keyframe& keyframe : map.keyframes) {
    const int number = map.graph.AddNode(keyframe.T_O_L());
    if (number == 0) continue;
    const LevelTransform step = {0, {0, 0.3, 0}};
    map.graph.AddEdge({number - 1, number, step, 1e-4 * Matrix4d::Identity(), false, 0.3});
  }
  map.graph.AddEdge({0, 3, {0, {0, 0.9, 0}}, 1e-3 * Matrix4d::Identity(), true});
  const std::string file = (Folder() / "map.plm").string();
  SaveMap(file, map);
  return ReadFile(file);
}

// Updates checksum and size, so that they do not reject the damaged file.
std::string Sealed(const std::string& payload, const Bytes& seed) {
  std::string file(seed.begin(), seed.begin() + kMapHeader);
  const uint64_t numbers[] = {payload.size(), testing::MapChecksum(payload)};
  std::memcpy(file.data() + kMapHeader - sizeof(numbers), numbers, sizeof(numbers));
  return file + payload;
}

}  // namespace

Target ConfigTarget() {
  std::vector<Bytes> seeds;
  for (const auto& entry : fs::directory_iterator(CONFIG_DIR)) {
    if (entry.path().extension() == ".yaml") seeds.push_back(ReadFile(entry.path()));
  }
  std::sort(seeds.begin(), seeds.end());  // directory order is arbitrary
  return {"config", seeds, [](const Bytes& bytes) {
            const fs::path file = Folder() / "config.yaml";
            Write(file, ToText(bytes));
            EffectiveValues(LoadConfig(file.string()));
          }};
}

// An input consists of both tables, with a zero byte in between.
Target AslTarget() {
  const std::string seed = ImuCsv() + std::string(1, '\0') + ImagesCsv();
  return {"asl", {ToBytes(seed)}, [](const Bytes& bytes) {
            const std::string text = ToText(bytes);
            const size_t end = text.find('\0');
            Write(Folder() / "asl" / "imu0" / "data.csv", text.substr(0, end));
            Write(Folder() / "asl" / "cam0" / "data.csv",
                  end == std::string::npos ? "" : text.substr(end + 1));
            const auto recording = OpenAslFolder((Folder() / "asl").string());
            while (const auto event = recording->Next()) {
              if (event->kind == RecordingEvent::Kind::kImage) recording->LoadImage();
            }
          }};
}

// Loads a map and continues it. An input consists of the data after the checksum.
Target MapTarget() {
  const std::shared_ptr<const CameraModel> camera = testing::SimpleCamera();
  const Bytes seed = SavedMap(*camera);
  const std::vector<Keyframe> flight = FlightAlongAWall(*camera, 1000, 60'000'000'000);
  return {"map", {Bytes(seed.begin() + kMapHeader, seed.end())}, [=](const Bytes& bytes) {
            const fs::path file = Folder() / "map.plm";
            Write(file, Sealed(ToText(bytes), seed));
            LoopCloser loops(LoopCloserOptions(*camera), camera);
            loops.SetMap(LoadMap(file.string()));
            for (const Keyframe& keyframe : flight) loops.Add(keyframe);
          }};
}

}  // namespace plm_vins::fuzz
