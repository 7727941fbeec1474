// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/streams/drop_counts.h"
#include "offline/recordings/confirmed_stamp.h"

namespace plm_vins {

// One line of an ASL csv file: the timestamp and the texts after it.
struct CsvRow {
  int64_t t_ns = 0;
  std::vector<std::string> values;
};

// Reads "stamp,value,..." lines one by one. Skips comments (#), empty lines and a byte order mark;
// skips and counts lines that do not have this form or whose timestamp is invalid (IsStamp()).
class CsvReader {
 public:
  // Throws std::runtime_error with the file name if it cannot be opened.
  CsvReader(const std::string& file, size_t values_per_row);

  std::optional<CsvRow> Next();

  // Counts the last line returned by Next() as bad, since its values are invalid.
  void Reject();

  // Place of the last line returned by Next(): "FILE:LINE".
  std::string Place() const { return file_ + ":" + std::to_string(line_number_); }

  int64_t bad_lines() const { return bad_lines_; }
  const std::string& first_bad_line() const { return first_bad_line_; }  // FILE:LINE

 private:
  std::optional<CsvRow> Parse(const std::string& line) const;

  std::string file_;
  size_t values_per_row_;
  std::ifstream stream_;
  int64_t line_number_ = 0;
  int64_t bad_lines_ = 0;
  std::string first_bad_line_;
};

// Provides the rows of an ASL csv file in temporal order; rows with equal timestamps keep the order
// of the file. Sorting is needed since tools list images in any order, and one row with a wrong
// timestamp would delay all others when two files are merged.
template <typename Row>
class SortedRows {
 public:
  struct Format {
    const char* key;   // name of the sensor in reports
    const char* name;  // name of a line's content in messages
    const char* line;  // expected format
    size_t values;     // number of values after the timestamp
    std::optional<Row> (*parse)(const CsvRow& row);
  };

  // Throws std::runtime_error if the file contains no valid row.
  SortedRows(const std::string& file, const Format& format)
      : key_(format.key), file_(file), reader_(file, format.values) {
    while (const auto row = reader_.Next()) Add(format.parse(*row));
    if (rows_.empty()) throw std::runtime_error(WhyEmpty(format));
    const auto is_earlier = [](const Row& a, const Row& b) { return a.t_ns < b.t_ns; };
    if (unsorted_.count > 0) std::stable_sort(rows_.begin(), rows_.end(), is_earlier);
  }

  const std::string& file() const { return file_; }

  // The row that Take() returns next; null at the end.
  const Row* next() const { return next_ < rows_.size() ? &rows_[next_] : nullptr; }
  const Row& Take() { return rows_[next_++]; }

  // The last timestamp, ignoring a single wrong one in the future.
  std::optional<int64_t> end_ns() const {
    ConfirmedStamp end;
    for (auto row = rows_.rbegin(); row != rows_.rend(); ++row) end.Add(row->t_ns);
    return end.t_ns();
  }

  DropCounts problems() const {
    return {{key_ + "_csv_lines_bad", reader_.bad_lines(), reader_.first_bad_line()}, unsorted_};
  }

 private:
  void Add(const std::optional<Row>& row) {
    if (!row) return reader_.Reject();
    if (!rows_.empty() && row->t_ns < rows_.back().t_ns) unsorted_.Add(reader_.Place());
    rows_.push_back(*row);
  }

  std::string WhyEmpty(const Format& format) const {
    const std::string text = std::string("no ") + format.name + " in " + file_ +
                             ": it has no line \"" + format.line + "\"";
    return reader_.bad_lines() == 0 ? text : text + "; see " + reader_.first_bad_line();
  }

  std::string key_;
  std::string file_;
  CsvReader reader_;
  std::vector<Row> rows_;
  size_t next_ = 0;
  DropCount unsorted_{key_ + "_csv_lines_not_in_order", 0, ""};  // sorted, not dropped
};

}  // namespace plm_vins
