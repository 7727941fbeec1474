// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

#include "common/io/output_file.h"

namespace plm_vins {

// A file of rows in order of time, as readers expect. Where stamps jump back it goes on in a new
// file, and the old one is kept as PartOf(path, 1), at the next jump (path, 2). What cannot be
// written throws as OutputFile does.
class TimedFile {
 public:
  // `header`: lines at the beginning of each file.
  explicit TimedFile(const std::string& path, const std::string& header = "");

  // Takes the row of that time.
  std::ostream& Row(int64_t t_ns);

  // Lines to come before the next row.
  void Comment(const std::string& lines) { comments_ += lines; }

  void Close();

  int parts() const { return parts_; }  // files that are kept beside the last one

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
