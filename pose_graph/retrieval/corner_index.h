// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "pose_graph/description/descriptor.h"

namespace plm_vins {

struct CornerIndexOptions {
  int tables = 4;
  int bits = 12;          // of the descriptor, that make a word of each table
  int max_distance = 32;  // between descriptors of what is taken for one corner [bits]
};

// Which images show the same corners, without a vocabulary: fixed bits of a descriptor are its
// words, one per table, as in [Usenko2020], and only descriptors that share a word are compared.
class CornerIndex {
 public:
  explicit CornerIndex(const CornerIndexOptions& options);

  void Add(int image, const std::vector<Descriptor>& descriptors);
  void Remove(int image, const std::vector<Descriptor>& descriptors);  // that were added

  // How similar the images are to one with these descriptors: each that an image has a like of
  // counts the more, the fewer images have. By image; those not named have none.
  std::map<int, double> Scores(const std::vector<Descriptor>& descriptors) const;

 private:
  struct Entry {
    int image;
    Descriptor descriptor;
  };

  uint64_t Word(const Descriptor& descriptor, int table) const;
  std::vector<int> ImagesWith(const Descriptor& descriptor) const;  // each once

  CornerIndexOptions options_;
  std::set<int> images_;
  std::vector<std::vector<Entry>> buckets_;  // table by table, by word
};

}  // namespace plm_vins
