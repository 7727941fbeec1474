// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "common/io/output_file.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// Writes a point cloud as ASCII PLY, point by point, so that its size is not limited by memory. The
// file is complete after Finish(). Throws on write errors, as OutputFile does.
class PlyPointWriter {
 public:
  explicit PlyPointWriter(const std::string& path);

  void Add(const Eigen::Vector3d& p_W);
  void Finish();

  int64_t size() const { return size_; }

 private:
  OutputFile file_;
  std::streampos count_position_;
  int64_t size_ = 0;
};

// Write observed line segments as edges between vertices: as ASCII PLY, colored red, green and
// blue by the axes x, y and z, gray if free; and as Wavefront OBJ, without colors.
void WriteSegmentsPly(const std::vector<MapLine>& lines, std::ostream* stream);
void WriteSegmentsObj(const std::vector<MapLine>& lines, std::ostream* stream);

}  // namespace plm_vins
