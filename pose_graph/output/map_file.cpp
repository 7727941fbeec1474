// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/output/map_file.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "common/io/binary_archive.h"

namespace plm_vins {
namespace {

constexpr char kSignature[] = "plm_vins map";
constexpr uint32_t kVersion = 4;

// [FNV]: 64-bit FNV-1a. Detects accidental damage, not manipulation.
uint64_t Checksum(const std::string& bytes) {
  uint64_t hash = 14695981039346656037ULL;
  for (const char byte : bytes) {
    hash ^= static_cast<uint8_t>(byte);
    hash *= 1099511628211ULL;
  }
  return hash;
}

// Layouts for reading and writing; Struct is const for writing.
template <typename Archive, typename Struct>
void Pose(Archive* archive, Struct& transform) {
  Values(archive, transform.translation, transform.rotation.coeffs());
}

template <typename Archive, typename Struct>
void Level(Archive* archive, Struct& transform) {
  Values(archive, transform.yaw, transform.translation);
}

template <typename Archive, typename Struct>
void Corner(Archive* archive, Struct& corner) {
  Values(archive, corner.track, corner.camera, corner.uv_px, corner.xy);
  if (archive->Has(corner.p_O)) Values(archive, *corner.p_O);
  for (auto& word : corner.descriptor) archive->Value(word);
}

template <typename Archive, typename Struct>
void Segment(Archive* archive, Struct& segment) {
  auto& observation = segment.observation;
  Values(archive, observation.id, observation.camera, observation.start, observation.end);
  if (!archive->Has(segment.landmark)) return;
  Values(archive, segment.landmark->start_O, segment.landmark->end_O);
}

template <typename Archive, typename Struct>
void Frame(Archive* archive, Struct& keyframe) {
  Values(archive, keyframe.t_ns, keyframe.world, keyframe.path);
  Pose(archive, keyframe.T_O_B);
  Values(archive, keyframe.covariance);
  archive->List(keyframe.T_B_C, [](auto* a, auto& T_B_C) { Pose(a, T_B_C); });
  archive->List(keyframe.corners, [](auto* a, auto& corner) { Corner(a, corner); });
  archive->List(keyframe.segments, [](auto* a, auto& segment) { Segment(a, segment); });
}

template <typename Archive, typename Struct>
void Edge(Archive* archive, Struct& edge) {
  Values(archive, edge.from, edge.to);
  Level(archive, edge.T_from_to);
  Values(archive, edge.covariance, edge.is_loop, edge.way);
}

template <typename Archive, typename Keyframes, typename Nodes, typename Edges>
void Map(Archive* archive, Keyframes& keyframes, Nodes& nodes, Edges& edges) {
  archive->List(keyframes, [](auto* a, auto& keyframe) { Frame(a, keyframe); });
  archive->List(nodes, [](auto* a, auto& node) { Level(a, node); });
  archive->List(edges, [](auto* a, auto& edge) { Edge(a, edge); });
}

KeyframeMap ParseMap(const std::string& bytes) try {
  KeyframeMap map;
  std::vector<LevelTransform> nodes;
  std::vector<LevelEdge> edges;
  std::istringstream stream(bytes);
  BinaryReader reader(&stream);
  Map(&reader, map.keyframes, nodes, edges);
  for (const LevelTransform& node : nodes) map.graph.AddNode(node);
  for (const LevelEdge& edge : edges) map.graph.AddEdge(edge);
  return map;
} catch (const std::runtime_error& error) {
  throw std::runtime_error(error.what() + std::string("; save the map again"));
}

std::string ReadPayload(std::istream* stream) {
  std::array<char, sizeof(kSignature)> signature = {};
  uint32_t version = 0;
  uint64_t size = 0, checksum = 0;
  stream->read(signature.data(), signature.size());
  if (std::string(signature.data(), signature.size()) !=
      std::string(kSignature, sizeof(kSignature))) {
    throw std::runtime_error("is not a map of plm_vins");
  }
  stream->read(reinterpret_cast<char*>(&version), sizeof(version));
  if (*stream && version != kVersion) {
    throw std::runtime_error("is a map of version " + std::to_string(version) +
                             ", this program reads version " + std::to_string(kVersion) +
                             "; record a new map, or use the version that saved it");
  }
  stream->read(reinterpret_cast<char*>(&size), sizeof(size));
  stream->read(reinterpret_cast<char*>(&checksum), sizeof(checksum));
  std::ostringstream rest;
  if (*stream) rest << stream->rdbuf();
  std::string bytes = rest.str();
  if (bytes.size() != size || Checksum(bytes) != checksum) {
    throw std::runtime_error("is damaged; save the map again");
  }
  return bytes;
}

void WriteStream(const std::string& bytes, std::ostream* stream) {
  const uint64_t size = bytes.size();
  const uint64_t checksum = Checksum(bytes);
  stream->write(kSignature, sizeof(kSignature));
  stream->write(reinterpret_cast<const char*>(&kVersion), sizeof(kVersion));
  stream->write(reinterpret_cast<const char*>(&size), sizeof(size));
  stream->write(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
  stream->write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

void SaveMap(const KeyframeMap& map, ReplacedFile* file) {
  std::ostringstream payload;
  BinaryWriter writer(&payload);
  const KeyframeMap kept = map.Compact();
  std::vector<LevelTransform> nodes;
  nodes.reserve(kept.graph.size());
  for (int i = 0; i < kept.graph.size(); ++i) nodes.push_back(kept.graph.node(i));
  Map(&writer, kept.keyframes, std::as_const(nodes), kept.graph.edges());
  WriteStream(payload.str(), &file->stream());
  file->Commit();
}

void SaveMap(const std::string& file, const KeyframeMap& map) {
  ReplacedFile replaced(file);
  SaveMap(map, &replaced);
}

KeyframeMap LoadMap(const std::string& file) {
  std::error_code error;  // an error is reported when the file is opened
  if (std::filesystem::is_directory(file, error)) {
    throw std::runtime_error(file + " is a folder; name the map file in it");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream && errno == ENOENT) {
    throw std::runtime_error(file + ": no such file; check the path of the map");
  }
  if (!stream) {
    throw std::runtime_error(file + " cannot be read: " + std::generic_category().message(errno));
  }
  try {
    return ParseMap(ReadPayload(&stream));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

PreviousMap LoadPreviousMap(const std::string& file) {
  std::error_code error;  // an inaccessible folder counts as one without a map
  if (std::filesystem::exists(file, error)) return {LoadMap(file), ""};
  return {{},
          "load_previous_pose_graph: there is no map " + file +
              "; starting with an empty one (pose_graph_save_path is its folder)"};
}

}  // namespace plm_vins
