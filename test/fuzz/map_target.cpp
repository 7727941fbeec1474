// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <memory>

#include "pose_graph/loop_closer.h"
#include "pose_graph/output/map_file.h"
#include "test/fuzz/fuzz_folder.h"
#include "test/fuzz/target.h"
#include "test/pose_graph/map_checksum.h"
#include "test/pose_graph/two_visits.h"

namespace plm_vins::fuzz {
namespace {

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

// Loads a map and continues it. An input consists of the data after the checksum.
Target MapTarget() {
  const std::shared_ptr<const CameraModel> camera = testing::SimpleCamera();
  const Bytes seed = SavedMap(*camera);
  const std::vector<Keyframe> flight = FlightAlongAWall(*camera, 1000, 60'000'000'000);
  return {"map", {Bytes(seed.begin() + kMapHeader, seed.end())}, [=](const Bytes& bytes) {
            const std::filesystem::path file = Folder() / "map.plm";
            Write(file, Sealed(ToText(bytes), seed));
            LoopCloser loops(LoopCloserOptions(*camera), camera);
            loops.SetMap(LoadMap(file.string()));
            for (const Keyframe& keyframe : flight) loops.Add(keyframe);
          }};
}

}  // namespace plm_vins::fuzz
