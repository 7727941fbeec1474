// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/ply_writer.h"

#include <string>

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr int kCountWidth = 12;  // reserved for the number of points, padded with blanks

std::string FormatPoint(const Eigen::Vector3d& p) {
  return Format("%.4f %.4f %.4f\n", p.x(), p.y(), p.z());
}

const char* Color(LineAxis axis) {
  switch (axis) {
    case LineAxis::kX:
      return "220 40 40";
    case LineAxis::kY:
      return "40 160 40";
    case LineAxis::kZ:
      return "50 90 230";
    default:
      return "140 140 140";
  }
}

constexpr char kFormat[] = "ply\nformat ascii 1.0\n";
constexpr char kCoordinates[] = "property float x\nproperty float y\nproperty float z\n";

}  // namespace

PlyPointWriter::PlyPointWriter(const std::string& path) : file_(path) {
  std::ostream& stream = file_.stream();
  stream << kFormat << "element vertex ";
  count_position_ = stream.tellp();
  stream << std::string(kCountWidth, ' ') << "\n" << kCoordinates << "end_header\n";
}

void PlyPointWriter::Add(const Eigen::Vector3d& p_W) {
  file_.stream() << FormatPoint(p_W);
  ++size_;
}

void PlyPointWriter::Finish() {
  file_.stream().seekp(count_position_);
  file_.stream() << size_;
  file_.Close();
}

void WriteSegmentsPly(const std::vector<MapLine>& lines, std::ostream* stream) {
  *stream << kFormat << "element vertex " << 2 * lines.size() << "\n"
          << kCoordinates << "element edge " << lines.size() << "\n"
          << "property int vertex1\nproperty int vertex2\n"
          << "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  for (const MapLine& line : lines) {
    *stream << FormatPoint(line.start_W) << FormatPoint(line.end_W);
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    *stream << 2 * i << " " << 2 * i + 1 << " " << Color(lines[i].axis) << "\n";
  }
}

void WriteSegmentsObj(const std::vector<MapLine>& lines, std::ostream* stream) {
  for (const MapLine& line : lines) {
    *stream << "v " << FormatPoint(line.start_W) << "v " << FormatPoint(line.end_W);
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    *stream << "l " << 2 * i + 1 << " " << 2 * i + 2 << "\n";
  }
}

}  // namespace plm_vins
