// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "common/streams/drop_counts.h"

namespace plm_vins {

// One serialised message of a bag.
struct BagMessage {
  std::string topic;
  std::string data;
};

// The messages of a bag in the order of their time of recording.
class BagMessageSource {
 public:
  virtual ~BagMessageSource() = default;

  virtual std::map<std::string, std::string> topics() const = 0;  // topic -> message type

  // Chooses what Next() gives; before the first Next().
  virtual void Select(const std::set<std::string>& topics) = 0;

  virtual std::optional<BagMessage> Next() = 0;

  virtual std::optional<int64_t> end_ns() const = 0;  // time of the last selected message
  virtual DropCounts problems() const = 0;            // what was left out
};

// Reads by the index at the bag's end. Throws std::exception where that is not possible.
std::unique_ptr<BagMessageSource> OpenIndexedBag(const std::string& file);

}  // namespace plm_vins
