// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/feature_file.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "common/features/feature_checks.h"
#include "common/io/binary_archive.h"

namespace plm_vins {
namespace {

constexpr char kKind[] = "plm_features v";
constexpr char kVersion[] = "3\n";

enum class ItemKind : uint8_t { kImu = 1, kPoints = 2, kPointsAndLines = 3 };

// Layouts for reading and writing; Struct is const for writing.
template <typename Archive, typename Struct>
void Imu(Archive* archive, Struct& sample) {
  Values(archive, sample.t_ns, sample.gyro, sample.accel);
}

template <typename Archive, typename Struct>
void Tracking(Archive* archive, Struct& tracked) {
  Values(archive, tracked.features.t_ns, tracked.restart, tracked.publish, tracked.tracking_ms);
}

template <typename Archive, typename Struct>
void Points(Archive* archive, Struct& tracked) {
  Tracking(archive, tracked);
  auto& s = tracked.statistics;
  Values(archive, s.previous, s.flow_lost, s.forward_backward, s.epipolar_outliers, s.crowded,
         s.detected);
  archive->List(tracked.features.points, [](auto* a, auto& point) {
    Values(a, point.id, point.camera, point.xy, point.uv_px, point.velocity);
    if (a->Has(point.depth)) Values(a, *point.depth);
  });
}

template <typename Archive, typename Struct>
void Lines(Archive* archive, Struct& tracked) {
  Tracking(archive, tracked);
  auto& s = tracked.statistics;
  Values(archive, s.previous, s.match_lost, s.inconsistent, s.edge_lost, s.duplicates, s.detected,
         s.fragments, s.candidates, s.added, s.detection_ms);
  archive->List(tracked.features.lines, [](auto* a, auto& line) {
    Values(a, line.id, line.camera, line.start, line.end, line.deviation);
  });
}

template <typename Archive, typename String>
void Text(Archive* archive, String& text) {
  archive->List(text, [](auto* a, auto& character) { a->Value(character); });
}

void RequireStamp(int64_t t_ns) {
  if (!IsStamp(t_ns)) throw std::runtime_error("is damaged");
}

// Parses JSON whose values are at most lists of numbers. Deeper nesting, which might overflow the
// stack, makes the whole text invalid.
Json ParseShallow(const std::string& text) {
  bool is_shallow = true;
  const auto is_taken = [&](int depth, Json::parse_event_t event, const Json&) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    const bool too_deep = opens && depth > 1;
    is_shallow = is_shallow && !too_deep;
    return !too_deep;
  };
  const Json json = Json::parse(text, is_taken, /*allow_exceptions=*/false);
  return is_shallow ? json : Json();
}

// Trackers never produce implausible observations.
template <typename Observation>
void RequirePossible(std::vector<Observation>* observations) {
  if (RemoveImpossible(observations) > 0) throw std::runtime_error("is damaged");
}

void ReadFrame(BinaryReader* input, ItemKind kind, TrackedFeatures* frame) {
  Points(input, frame->points);
  if (kind == ItemKind::kPointsAndLines) Lines(input, frame->lines.emplace());
  RequireStamp(frame->points.features.t_ns);
  RequirePossible(&frame->points.features.points);
  if (!frame->lines) return;
  RequireStamp(frame->lines->features.t_ns);
  RequirePossible(&frame->lines->features.lines);
}

}  // namespace

FeatureFileWriter::FeatureFileWriter(const std::string& file, const Json& tracker_values)
    : file_(file) {
  file_.stream() << kKind << kVersion;
  BinaryWriter writer(&file_.stream());
  const std::string text = tracker_values.dump();
  Text(&writer, text);
}

void FeatureFileWriter::Add(const TrackedItem& item) {
  BinaryWriter output(&file_.stream());
  if (!item.frame) {
    output.Value(ItemKind::kImu);
    Imu(&output, item.imu);
    return;
  }
  const TrackedFeatures& frame = *item.frame;
  output.Value(frame.lines ? ItemKind::kPointsAndLines : ItemKind::kPoints);
  Points(&output, frame.points);
  if (frame.lines) Lines(&output, *frame.lines);
}

void FeatureFileWriter::Close() { file_.Commit(); }

FeatureFileReader::FeatureFileReader(const std::string& file)
    : file_(file), stream_(file, std::ios::binary) {
  if (!stream_) throw std::runtime_error(file + ": cannot be read; check the path");
  std::string kind, version;
  kind.resize(sizeof(kKind) - 1);
  version.resize(sizeof(kVersion) - 1);
  stream_.read(kind.data(), static_cast<std::streamsize>(kind.size()));
  stream_.read(version.data(), static_cast<std::streamsize>(version.size()));
  if (kind != kKind) {
    throw std::runtime_error(file + ": is not a feature file; --save-features writes one");
  }
  if (version != kVersion) throw Unusable("was written by another version of this program");
  ReadTrackerValues();
}

void FeatureFileReader::ReadTrackerValues() {
  std::string text;
  try {
    BinaryReader reader(&stream_);
    Text(&reader, text);
  } catch (const std::runtime_error& error) {
    throw Unusable(error.what());
  }
  tracker_values_ = ParseShallow(text);
  if (!tracker_values_.is_object()) throw Unusable("is damaged");
}

std::runtime_error FeatureFileReader::Unusable(const std::string& why) const {
  return std::runtime_error(file_ + ": " + why + "; record it again with --save-features");
}

std::optional<TrackedItem> FeatureFileReader::Next() {
  if (stream_.peek() == std::ifstream::traits_type::eof()) return std::nullopt;
  try {
    BinaryReader input(&stream_);
    TrackedItem item;
    ItemKind kind = ItemKind::kImu;
    input.Value(kind);
    if (kind == ItemKind::kImu) {
      Imu(&input, item.imu);
      RequireStamp(item.imu.t_ns);
      return item;
    }
    if (kind < ItemKind::kImu || kind > ItemKind::kPointsAndLines) {
      throw std::runtime_error("is damaged");
    }
    item.frame = std::make_unique<TrackedFeatures>();
    ReadFrame(&input, kind, item.frame.get());
    return item;
  } catch (const std::runtime_error& error) {
    throw Unusable(error.what());
  }
}

}  // namespace plm_vins
