// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/retrieval/corner_index.h"

#include <algorithm>
#include <cmath>

namespace plm_vins {

CornerIndex::CornerIndex(const CornerIndexOptions& options)
    : options_(options), buckets_(static_cast<size_t>(options.tables) << options.bits) {}

// Table t uses the bits t, t + tables, t + 2 tables, ...: the ORB pattern is sorted, with the most
// discriminative comparisons first [Rublee2011], and so all tables share the best bits.
uint64_t CornerIndex::Word(const Descriptor& descriptor, int table) const {
  uint64_t word = static_cast<uint64_t>(table);
  for (int i = 0; i < options_.bits; ++i) {
    const int bit = i * options_.tables + table;
    word = word << 1 | (descriptor[bit / 64] >> (bit % 64) & 1);
  }
  return word;
}

void CornerIndex::Add(const MapImage& image, const std::vector<Descriptor>& descriptors) {
  images_.insert(image);
  for (const Descriptor& descriptor : descriptors) {
    for (int table = 0; table < options_.tables; ++table) {
      buckets_[Word(descriptor, table)].push_back({image, descriptor});
    }
  }
}

void CornerIndex::Remove(const MapImage& image, const std::vector<Descriptor>& descriptors) {
  images_.erase(image);
  for (const Descriptor& descriptor : descriptors) {
    for (int table = 0; table < options_.tables; ++table) {
      std::vector<Entry>& bucket = buckets_[Word(descriptor, table)];
      bucket.erase(std::remove_if(bucket.begin(), bucket.end(),
                                  [&image](const Entry& entry) { return entry.image == image; }),
                   bucket.end());
    }
  }
}

PLM_COUNTS_BITS
std::vector<MapImage> CornerIndex::ImagesWith(const Descriptor& descriptor) const {
  std::vector<MapImage> images;
  for (int table = 0; table < options_.tables; ++table) {
    for (const Entry& entry : buckets_[Word(descriptor, table)]) {
      const int distance = HammingDistance(entry.descriptor, descriptor);
      if (distance <= options_.max_distance) images.push_back(entry.image);
    }
  }
  std::sort(images.begin(), images.end());
  images.erase(std::unique(images.begin(), images.end()), images.end());
  return images;
}

std::map<MapImage, double> CornerIndex::Scores(const std::vector<Descriptor>& descriptors) const {
  const auto image_count = static_cast<double>(images_.size());
  std::map<MapImage, double> scores;
  for (const Descriptor& descriptor : descriptors) {
    const std::vector<MapImage> images = ImagesWith(descriptor);
    if (images.empty()) continue;
    const double weight = std::log((image_count + 1) / static_cast<double>(images.size()));
    for (const MapImage& image : images) scores[image] += weight;
  }
  return scores;
}

}  // namespace plm_vins
