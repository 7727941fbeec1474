// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

namespace plm_vins {

// Distributes selected items over bins, such as image regions: Pop() returns the best candidate of
// the bin that has the fewest items.
template <typename Item>
class PoorestBinQueue {
 public:
  explicit PoorestBinQueue(size_t bin_count) : bins_(bin_count) {}

  // Candidates must be added best first.
  void AddCandidate(size_t bin, const Item& item) { bins_[bin].candidates.push_back(item); }

  // Counts an existing item, or a candidate that was selected.
  void Count(size_t bin) { ++bins_[bin].count; }

  std::optional<Item> Pop() {
    Bin* poorest = nullptr;
    for (Bin& bin : bins_) {
      if (bin.next == bin.candidates.size()) continue;
      if (poorest == nullptr || bin.count < poorest->count) poorest = &bin;
    }
    if (poorest == nullptr) return std::nullopt;
    return poorest->candidates[poorest->next++];
  }

 private:
  struct Bin {
    std::vector<Item> candidates;
    size_t next = 0;
    int count = 0;
  };

  std::vector<Bin> bins_;
};

}  // namespace plm_vins
