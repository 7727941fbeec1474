// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/in_place_queue.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <thread>

namespace plm_vins {
namespace {

struct Callback : ros::CallbackInterface {
  CallResult call() override {
    ++calls;
    thread = std::this_thread::get_id();
    return Success;
  }
  int calls = 0;
  std::thread::id thread;
};

TEST(InPlaceQueue, CallsAtOnceInTheCallingThread) {
  const auto callback = boost::make_shared<Callback>();
  InPlaceQueue queue;
  queue.addCallback(callback, 1);
  EXPECT_EQ(callback->calls, 1);
  EXPECT_EQ(callback->thread, std::this_thread::get_id());
}

}  // namespace
}  // namespace plm_vins
