// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "test/fuzz/mutator.h"

namespace plm_vins::fuzz {

// What takes input from outside. `run` may throw std::exception, as callers do catch that; whatever
// else ends the program is a finding.
struct Target {
  std::string name;
  std::vector<Bytes> seeds;  // good inputs
  std::function<void(const Bytes&)> run;
  std::function<std::string()> report = [] { return std::string("no finding"); };
};

// Says something about the input that is being run.
void Note(const std::string& what);

// Those of the program.
std::vector<Target> Targets();

Target ConfigTarget();
Target AslTarget();
Target MapTarget();
Target StageTarget();
Target DivergenceTarget();
Target PointTrackerTarget();
Target LineTrackerTarget();

// The numbers in an input, one after the other; zeros after its end.
class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}

  bool empty() const { return at_ >= bytes_.size(); }
  uint8_t Byte() { return empty() ? 0 : bytes_[at_++]; }
  template <typename T>
  T Value() {
    T value{};
    const size_t length = std::min(sizeof(T), bytes_.size() - std::min(at_, bytes_.size()));
    std::memcpy(&value, bytes_.data() + at_, length);
    at_ += length;
    return value;
  }

 private:
  const Bytes& bytes_;
  size_t at_ = 0;
};

}  // namespace plm_vins::fuzz
