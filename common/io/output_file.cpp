// SPDX-License-Identifier: BSD-3-Clause
#include "common/io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace plm_vins {
namespace {

std::string Unfinished(const std::string& path) { return path + ".part"; }

[[noreturn]] void Fail(const std::string& name, const std::string& reason) {
  throw std::runtime_error("cannot write " + name + ": " + reason);
}

// Waits until the data of `path`, which errors call `name`, are on the disk. File systems that do
// not support this are tolerated.
void Synchronize(const std::string& path, const std::string& name) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int failed = descriptor < 0 || ::fsync(descriptor) < 0 ? errno : 0;
  if (descriptor >= 0) ::close(descriptor);
  if (failed != 0 && failed != EINVAL && failed != ENOTSUP) {
    Fail(name, std::generic_category().message(failed));
  }
}

// Resolves symbolic links. Throws if a device or folder would be replaced.
std::string ToReplace(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return path;
  if (!std::filesystem::is_regular_file(path, error)) {
    Fail(path, "it exists and is not a regular file");
  }
  return std::filesystem::canonical(path).string();
}

}  // namespace

OutputFile::OutputFile(const std::string& path, const std::string& name)
    : name_(name), stream_(path, std::ios::binary) {
  if (!stream_) Fail(name_, std::generic_category().message(errno));
}

std::ostream& OutputFile::stream() {
  Check();
  return stream_;
}

void OutputFile::Close() {
  stream_.close();
  Check();
}

void OutputFile::Check() const {
  if (!stream_) Fail(name_, "disk full?");
}

ReplacedFile::ReplacedFile(const std::string& path)
    : path_(ToReplace(path)), unfinished_(Unfinished(path_), path) {}

ReplacedFile::~ReplacedFile() { std::remove(Unfinished(path_).c_str()); }

void ReplacedFile::Commit() {
  unfinished_.Close();
  Synchronize(Unfinished(path_), path_);
  std::error_code error;
  std::filesystem::rename(Unfinished(path_), path_, error);
  if (error) Fail(path_, error.message());
}

}  // namespace plm_vins
