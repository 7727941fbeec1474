// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "pose_graph/description/descriptor.h"
#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {

struct CornerIndexOptions {
  int tables = 4;
  int bits = 12;          // descriptor bits that form a word of each table
  int max_distance = 32;  // between descriptors of the same corner [bits]
};

// Image retrieval without a trained vocabulary: each table maps a fixed subset of descriptor bits
// to a word, as in [Usenko2020], and only descriptors that share a word are compared.
class CornerIndex {
 public:
  explicit CornerIndex(const CornerIndexOptions& options = {});

  void Add(const MapImage& image, const std::vector<Descriptor>& descriptors);
  // The image must have been added.
  void Remove(const MapImage& image, const std::vector<Descriptor>& descriptors);

  // Similarity of the indexed images to an image with these descriptors: matches are weighted by
  // inverse document frequency. Images without a match are missing in the result.
  std::map<MapImage, double> Scores(const std::vector<Descriptor>& descriptors) const;

 private:
  struct Entry {
    MapImage image;
    Descriptor descriptor;
  };

  uint64_t Word(const Descriptor& descriptor, int table) const;
  std::vector<MapImage> ImagesWith(const Descriptor& descriptor) const;  // images, each once

  CornerIndexOptions options_;
  std::set<MapImage> images_;
  std::vector<std::vector<Entry>> buckets_;  // tables one after another, each indexed by word
};

}  // namespace plm_vins
