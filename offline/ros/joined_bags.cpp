// SPDX-License-Identifier: BSD-3-Clause
#include "offline/ros/joined_bags.h"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace plm_vins {
namespace {

void RequireReadable(const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    throw std::runtime_error(file + " is not a file");
  }
  if (!std::ifstream(file)) {
    const std::string reason = std::generic_category().message(errno);
    throw std::runtime_error("cannot read " + file + ": " + reason);
  }
}

std::unique_ptr<IndexedBag> Open(const std::string& file) {
  RequireReadable(file);
  try {
    return std::make_unique<IndexedBag>(file);
  } catch (const std::exception& error) {  // exceptions of bag parsing, or std::bad_alloc
    throw std::runtime_error(
        file +
        " is not a ROS bag of format 2.0, or it is truncated, damaged or was never closed (" +
        error.what() + "); \"rosbag reindex " + file + "\" repairs a truncated or unclosed bag");
  }
}

// Adds counts to sums of the same causes in the same order.
void AddUp(const DropCounts& counts, DropCounts* sums) {
  if (sums->empty()) sums->resize(counts.size());
  for (size_t i = 0; i < counts.size(); ++i) {
    DropCount& sum = (*sums)[i];
    sum.cause = counts[i].cause;
    sum.count += counts[i].count;
    if (sum.detail.empty()) sum.detail = counts[i].detail;
  }
}

}  // namespace

JoinedBags::JoinedBags(const std::vector<std::string>& files) {
  for (const std::string& file : files) bags_.push_back(Open(file));
}

TypedTopics JoinedBags::topics() const {
  TypedTopics topics;
  for (const auto& bag : bags_) {
    const TypedTopics some = bag->topics();
    topics.insert(some.begin(), some.end());
  }
  return topics;
}

void JoinedBags::Select(const TypedTopics& topics) {
  for (const auto& bag : bags_) bag->Select(topics);
}

std::optional<BagMessage> JoinedBags::Next() {
  const auto is_earlier = [](const auto& a, const auto& b) {
    const auto a_ns = a->next_ns(), b_ns = b->next_ns();
    return a_ns && (!b_ns || *a_ns < *b_ns);
  };
  // Next() of a bag returns nullopt despite next_ns() if its last messages are unreadable.
  while (true) {
    const auto first = std::min_element(bags_.begin(), bags_.end(), is_earlier);
    if (first == bags_.end() || !(*first)->next_ns()) return std::nullopt;
    if (auto message = (*first)->Next()) return message;
  }
}

std::optional<int64_t> JoinedBags::end_ns() const {
  std::optional<int64_t> end_ns;
  for (const auto& bag : bags_) end_ns = std::max(end_ns, bag->end_ns());  // nullopt is the least
  return end_ns;
}

DropCounts JoinedBags::problems() const {
  DropCounts sums;
  for (const auto& bag : bags_) AddUp(bag->problems(), &sums);
  return sums;
}

}  // namespace plm_vins
