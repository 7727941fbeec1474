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

// A point cloud as ASCII PLY, written point by point, so that a long run needs no memory for it.
// The file is complete after Finish(). What cannot be written throws as OutputFile does.
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

// Seen parts of lines as edges between vertices (ASCII PLY), red, green and blue along the axes x,
// y and z, grey where free; and as Wavefront OBJ, without.
void WriteSegmentsPly(const std::vector<MapLine>& lines, std::ostream* stream);
void WriteSegmentsObj(const std::vector<MapLine>& lines, std::ostream* stream);

}  // namespace plm_vins
