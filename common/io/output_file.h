// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <ostream>
#include <string>

namespace plm_vins {

// A file being written. Throws std::runtime_error with the file name if it cannot be opened. Write
// errors (a full disk) are thrown by a later stream(), or at the latest by Close().
class OutputFile {
 public:
  explicit OutputFile(const std::string& path) : OutputFile(path, path) {}
  // Errors call the file `name`.
  OutputFile(const std::string& path, const std::string& name);

  std::ostream& stream();

  // Flushes all data to the operating system.
  void Close();

 private:
  void Check() const;

  std::string name_;
  std::ofstream stream_;
};

// A file that is replaced atomically: readers see the old content until Commit(), then the new one,
// even after a power loss. Without Commit() the file is unchanged; only PATH.part is left if the
// program is killed.
class ReplacedFile {
 public:
  // Starts writing PATH.part. Throws std::runtime_error if it cannot be opened.
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
