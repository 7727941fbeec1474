// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace plm_vins::simulator {

// A text file being written; every failure throws std::runtime_error naming it.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path)
      : path_(path), file_(std::fopen(path.c_str(), "w"), &std::fclose) {
    if (!file_) Fail();
  }

  void Write(const std::string& text) {
    if (std::fputs(text.c_str(), file_.get()) < 0) Fail();
  }

 private:
  [[noreturn]] void Fail() const { throw std::runtime_error("cannot write " + path_); }

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace plm_vins::simulator
