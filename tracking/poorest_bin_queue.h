// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

namespace plm_vins {

// Spreads a choice over bins, such as parts of an image: it is always the turn of the bin that has
// the fewest items, and there of its best candidate.
template <typename Item>
class PoorestBinQueue {
 public:
  explicit PoorestBinQueue(size_t bin_count) : bins_(bin_count) {}

  // To be added best first.
  void AddCandidate(size_t bin, const Item& item) { bins_[bin].candidates.push_back(item); }

  // An item that exists, or a candidate that was taken.
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
