// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "test/fuzz/mutator.h"

namespace plm_vins::fuzz {

// A function that processes external input. `run` may throw std::exception, which callers catch;
// any other abnormal end is a finding.
struct Target {
  std::string name;
  std::vector<Bytes> seeds;  // valid inputs
  std::function<void(const Bytes&)> run;
  std::function<std::string()> report = [] { return std::string("no finding"); };
};

// Adds a remark about the current input.
void Note(const std::string& what);

// Returns the targets of this program.
std::vector<Target> Targets();

Target ConfigTarget();
Target AslTarget();
Target StageTarget();
Target DivergenceTarget();
Target PointTrackerTarget();
Target LineTrackerTarget();

// Reads consecutive numbers from an input; zeros after its end.
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
