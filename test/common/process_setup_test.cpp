// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_setup.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <thread>
#include <vector>

namespace plm_vins {
namespace {

constexpr size_t kPage = 4096;  // [bytes]
constexpr size_t kMegabyte = size_t{1} << 20;

int64_t PageFaults() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

// Counts page faults while this number of megabyte blocks is allocated, filled and freed,
// repeatedly.
int64_t FaultsOfBlocks(size_t blocks, int times) {
  const int64_t before = PageFaults();
  for (int i = 0; i < times; ++i) {
    std::vector<std::unique_ptr<char[]>> taken;
    for (size_t block = 0; block < blocks; ++block) {
      taken.emplace_back(new char[kMegabyte]);
      std::fill_n(static_cast<volatile char*>(taken.back().get()), kMegabyte, 'x');
    }
  }
  return PageFaults() - before;
}

class ProcessSetup : public ::testing::Test {
 protected:
  void SetUp() override { SetUpProcess(); }
};

TEST_F(ProcessSetup, LeavesOpenCvOneThread) { EXPECT_EQ(cv::getNumThreads(), 1); }

#ifdef __GLIBC__
TEST_F(ProcessSetup, KeepsMemoryThatIsFreed) {
  constexpr size_t kBlocks = 24;
  constexpr int kTimes = 20;
  constexpr auto kPages = static_cast<int64_t>(kBlocks * kMegabyte / kPage);
  EXPECT_LT(FaultsOfBlocks(kBlocks, kTimes), 2 * kPages);
  int64_t of_thread = 0;
  std::thread([&of_thread] { of_thread = FaultsOfBlocks(kBlocks, kTimes); }).join();
  EXPECT_LT(of_thread, 2 * kPages);
}
#endif

}  // namespace
}  // namespace plm_vins
