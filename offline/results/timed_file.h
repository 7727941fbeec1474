// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

#include "common/io/output_file.h"

namespace plm_vins {

// A file of rows in temporal order, as readers expect. At the n-th backward jump of the timestamps,
// the file is renamed to PartOf(path, n), and a new file begins. Throws std::runtime_error with the
// file name, as OutputFile does.
class TimedFile {
 public:
  // `header` is written at the beginning of each file.
  explicit TimedFile(const std::string& path, const std::string& header = "");

  // Returns the stream for the row with this timestamp.
  std::ostream& Row(int64_t t_ns);

  // Adds lines to be written before the next row.
  void Comment(const std::string& lines) { comments_ += lines; }

  void Close();

  int parts() const { return parts_; }  // number of files before the last one

  // NAME.EXT -> NAME_1.EXT
  static std::string PartOf(const std::string& path, int number);

 private:
  void BeginAnew();

  std::string path_;
  std::string header_;
  OutputFile file_;
  std::string comments_;
  std::optional<int64_t> last_ns_;
  int parts_ = 0;
};

}  // namespace plm_vins
