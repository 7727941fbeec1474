// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <ostream>
#include <string>

namespace plm_vins {

// A file being written. What cannot be written throws std::runtime_error that names the file: where
// it cannot be opened at once, on a full disk at a later stream(), and in Close() at the latest.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path) : OutputFile(path, path) {}
  // Errors call it `name`.
  OutputFile(const std::string& path, const std::string& name);

  std::ostream& stream();

  // Everything is on its way to the disk afterwards.
  void Close();

 private:
  void Check() const;

  std::string name_;
  std::ofstream stream_;
};

// A file that is replaced in one step: readers see the old one until Commit(), then the new one,
// never half of it, not even after a loss of power. What is not committed leaves no trace, but
// for PATH.part where the program is killed meanwhile.
class ReplacedFile {
 public:
  // Begins to write beside the file. Throws as OutputFile does.
  explicit ReplacedFile(const std::string& path);
  ~ReplacedFile();
  ReplacedFile(const ReplacedFile&) = delete;
  ReplacedFile& operator=(const ReplacedFile&) = delete;

  std::ostream& stream() { return unfinished_.stream(); }
  void Commit();

 private:
  std::string path_;
  OutputFile unfinished_;
};

}  // namespace plm_vins
