// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_setup.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <thread>

namespace plm_vins {
namespace {

constexpr size_t kPage = 4096;  // [bytes]

int64_t PageFaults() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

// How many pages come from the system where a block of this size is taken, filled and freed again
// and again.
int64_t FaultsOfBlocks(size_t bytes, int times) {
  const int64_t before = PageFaults();
  for (int i = 0; i < times; ++i) {
    const std::unique_ptr<char[]> block(new char[bytes]);
    std::fill_n(static_cast<volatile char*>(block.get()), bytes, 'x');
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
  constexpr size_t kBytes = size_t{8} << 20;
  constexpr auto kPages = static_cast<int64_t>(kBytes / kPage);
  constexpr int kTimes = 20;
  EXPECT_LT(FaultsOfBlocks(kBytes, kTimes), 2 * kPages);
  int64_t of_thread = 0;
  std::thread([&of_thread] { of_thread = FaultsOfBlocks(kBytes, kTimes); }).join();
  EXPECT_LT(of_thread, 2 * kPages);
}
#endif

}  // namespace
}  // namespace plm_vins
