// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

namespace plm_vins::testing {

// Returns the message of the exception that `function` throws; empty if it does not throw.
template <typename Function>
std::string MessageOf(const Function& function) {
  try {
    function();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace plm_vins::testing
