// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

namespace plm_vins {

// The rows of a file, each with its t_ns, without those whose stamp is alone in the future: where
// files are merged by time, such a one would hold up all that follow. A stamp is alone where the
// next row goes back by more than a second, but not to before the row before.
template <typename Row>
class OrderedRows {
 public:
  explicit OrderedRows(std::function<std::optional<Row>()> read) : read_(std::move(read)) {
    ahead_ = read_();
  }

  std::optional<Row> Next() {
    std::optional<Row> row = Advance();
    while (row && ahead_ && IsAlone(row->t_ns)) {
      ++dropped_;
      row = Advance();
    }
    if (row) last_ns_ = row->t_ns;
    return row;
  }

  int64_t dropped() const { return dropped_; }

 private:
  static constexpr int64_t kMinLeap_ns = 1'000'000'000;

  std::optional<Row> Advance() {
    std::optional<Row> row = std::move(ahead_);
    ahead_ = row ? read_() : std::nullopt;
    return row;
  }

  bool IsAlone(int64_t t_ns) const {
    return t_ns - ahead_->t_ns > kMinLeap_ns && (!last_ns_ || ahead_->t_ns > *last_ns_);
  }

  std::function<std::optional<Row>()> read_;
  std::optional<Row> ahead_;        // read, not given yet
  std::optional<int64_t> last_ns_;  // of the last row given
  int64_t dropped_ = 0;
};

}  // namespace plm_vins
