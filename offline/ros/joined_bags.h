// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/streams/drop_counts.h"
#include "offline/ros/indexed_bag.h"

namespace plm_vins {

// Reads several bags, such as those of `rosbag record --split`, as if they were one: messages are
// merged by their recording time, whatever the order of the files.
class JoinedBags {
 public:
  // Throws std::runtime_error if a file cannot be read, is not a bag or has no index.
  explicit JoinedBags(const std::vector<std::string>& files);

  // The functions of IndexedBag, for all bags together.
  TypedTopics topics() const;
  void Select(const TypedTopics& topics);
  std::optional<BagMessage> Next();
  std::optional<int64_t> end_ns() const;
  DropCounts problems() const;

 private:
  std::vector<std::unique_ptr<IndexedBag>> bags_;
};

}  // namespace plm_vins
