// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <thread>

namespace plm_vins::testing {

// Returns whether `other` finishes while `save` is blocked by a slow disk, simulated by a full pipe
// in place of the file.
inline bool EndsWhileSaving(const std::string& file, const std::function<void()>& save,
                            const std::function<void()>& other) {
  using std::chrono::milliseconds;
  const std::string unfinished = file + ".part";
  EXPECT_EQ(::mkfifo(unfinished.c_str(), 0600), 0);
  const int pipe = ::open(unfinished.c_str(), O_RDWR | O_NONBLOCK);
  std::array<char, 4096> block = {};
  while (::write(pipe, block.data(), block.size()) > 0) {
  }
  const auto saving = std::async(std::launch::async, save);
  std::this_thread::sleep_for(milliseconds(50));  // until it blocks
  const auto beside = std::async(std::launch::async, other);
  const bool ends = beside.wait_for(milliseconds(2000)) == std::future_status::ready;
  while (saving.wait_for(milliseconds(1)) != std::future_status::ready) {
    while (::read(pipe, block.data(), block.size()) > 0) {
    }
  }
  ::close(pipe);
  return ends;
}

}  // namespace plm_vins::testing
