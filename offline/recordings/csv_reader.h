// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace plm_vins
