// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/feature_file.h"

#include <array>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "common/features/feature_checks.h"

namespace plm_vins {
namespace {

constexpr std::array<char, 16> kSignature = {'p', 'l', 'm', '_', 'f', 'e', 'a', 't',
                                             'u', 'r', 'e', 's', ' ', 'v', '1', '\n'};
constexpr uint32_t kMostFeatures = 1 << 20;  // of one image: more are no features but damage

enum class ItemKind : uint8_t { kImu = 1, kPoints = 2, kPointsAndLines = 3 };

// Both archives have the same interface, so that one function per struct below defines its layout.
class Output {
 public:
  explicit Output(std::ostream* stream) : stream_(stream) {}

  template <typename T>
  void Value(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    stream_->write(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  template <typename T>
  void Size(const std::vector<T>& values) {
    Value(static_cast<uint32_t>(values.size()));
  }

 private:
  std::ostream* stream_;
};

class Input {
 public:
  explicit Input(std::istream* stream) : stream_(stream) {}

  template <typename T>
  void Value(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    std::array<char, sizeof(T)> bytes;
    if (!stream_->read(bytes.data(), bytes.size())) throw std::runtime_error("ends in an item");
    std::memcpy(&value, bytes.data(), sizeof(T));
  }
  void Value(bool& value) {
    uint8_t byte = 0;
    Value(byte);
    if (byte > 1) throw std::runtime_error("is damaged");
    value = byte == 1;
  }
  template <typename T>
  void Size(std::vector<T>& values) {
    uint32_t size = 0;
    Value(size);
    if (size > kMostFeatures) throw std::runtime_error("is damaged");
    values.resize(size);
  }

 private:
  std::istream* stream_;
};

// Layouts; Struct is const where it is written.
template <typename Archive, typename Vector>
void Coordinates(Archive* archive, Vector& vector) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) archive->Value(vector[i]);
}

template <typename Archive, typename Struct>
void Imu(Archive* archive, Struct& sample) {
  archive->Value(sample.t_ns);
  Coordinates(archive, sample.gyro);
  Coordinates(archive, sample.accel);
}

template <typename Archive, typename Struct>
void Tracking(Archive* archive, Struct& tracked) {
  archive->Value(tracked.features.t_ns);
  archive->Value(tracked.restart);
  archive->Value(tracked.publish);
  archive->Value(tracked.tracking_ms);
}

template <typename Archive, typename Struct>
void PointStatistics(Archive* archive, Struct& statistics) {
  archive->Value(statistics.previous);
  archive->Value(statistics.flow_lost);
  archive->Value(statistics.forward_backward);
  archive->Value(statistics.epipolar_outliers);
  archive->Value(statistics.crowded);
  archive->Value(statistics.detected);
}

template <typename Archive, typename Struct>
void Points(Archive* archive, Struct& tracked) {
  Tracking(archive, tracked);
  PointStatistics(archive, tracked.statistics);
  archive->Size(tracked.features.points);
  for (auto& point : tracked.features.points) {
    archive->Value(point.id);
    Coordinates(archive, point.xy);
    Coordinates(archive, point.uv_px);
    Coordinates(archive, point.velocity);
  }
}

template <typename Archive, typename Struct>
void LineStatistics(Archive* archive, Struct& statistics) {
  archive->Value(statistics.previous);
  archive->Value(statistics.match_lost);
  archive->Value(statistics.inconsistent);
  archive->Value(statistics.edge_lost);
  archive->Value(statistics.duplicates);
  archive->Value(statistics.detected);
  archive->Value(statistics.fragments);
  archive->Value(statistics.candidates);
  archive->Value(statistics.added);
  archive->Value(statistics.detection_ms);
}

template <typename Archive, typename Struct>
void Lines(Archive* archive, Struct& tracked) {
  Tracking(archive, tracked);
  LineStatistics(archive, tracked.statistics);
  archive->Size(tracked.features.lines);
  for (auto& line : tracked.features.lines) {
    archive->Value(line.id);
    Coordinates(archive, line.start);
    Coordinates(archive, line.end);
  }
}

void RequireStamp(int64_t t_ns) {
  if (!IsStamp(t_ns)) throw std::runtime_error("is damaged");
}

// Trackers give nothing else.
template <typename Observation>
void RequirePossible(std::vector<Observation>* observations) {
  if (RemoveImpossible(observations) > 0) throw std::runtime_error("is damaged");
}

}  // namespace

FeatureFileWriter::FeatureFileWriter(const std::string& file) : file_(file) {
  file_.stream().write(kSignature.data(), kSignature.size());
}

void FeatureFileWriter::Add(const TrackedItem& item) {
  Output output(&file_.stream());
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
  std::array<char, kSignature.size()> signature = {};
  stream_.read(signature.data(), signature.size());
  if (signature != kSignature) {
    throw std::runtime_error(file + ": no features of this version; write it with --save-features");
  }
}

std::optional<TrackedItem> FeatureFileReader::Next() {
  if (stream_.peek() == std::ifstream::traits_type::eof()) return std::nullopt;
  try {
    Input input(&stream_);
    TrackedItem item;
    ItemKind kind = ItemKind::kImu;
    input.Value(kind);
    if (kind == ItemKind::kImu) {
      Imu(&input, item.imu);
      RequireStamp(item.imu.t_ns);
      return item;
    }
    if (kind != ItemKind::kPoints && kind != ItemKind::kPointsAndLines) {
      throw std::runtime_error("is damaged");
    }
    item.frame = std::make_unique<TrackedFeatures>();
    Points(&input, item.frame->points);
    RequireStamp(item.t_ns());
    RequirePossible(&item.frame->points.features.points);
    if (kind == ItemKind::kPointsAndLines) {
      Lines(&input, item.frame->lines.emplace());
      RequireStamp(item.frame->lines->features.t_ns);
      RequirePossible(&item.frame->lines->features.lines);
    }
    return item;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file_ + ": " + error.what() + "; write it again with --save-features");
  }
}

}  // namespace plm_vins
