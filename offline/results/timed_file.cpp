// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/timed_file.h"

#include <filesystem>
#include <utility>

namespace plm_vins {

namespace fs = std::filesystem;

TimedFile::TimedFile(const std::string& path, const std::string& header)
    : path_(path), header_(header), file_(path) {
  file_.stream() << header_;
}

std::ostream& TimedFile::Row(int64_t t_ns) {
  if (last_ns_ && t_ns <= *last_ns_) BeginAnew();
  last_ns_ = t_ns;
  return file_.stream() << std::exchange(comments_, "");
}

void TimedFile::BeginAnew() {
  file_.Close();
  fs::rename(path_, PartOf(path_, ++parts_));
  file_ = OutputFile(path_);
  file_.stream() << header_;
}

void TimedFile::Close() {
  file_.stream() << std::exchange(comments_, "");
  file_.Close();
}

std::string TimedFile::PartOf(const std::string& path, int number) {
  const fs::path file(path);
  const std::string name = file.stem().string() + "_" + std::to_string(number);
  return file.parent_path() / (name + file.extension().string());
}

}  // namespace plm_vins
