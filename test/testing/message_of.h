// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

namespace plm_vins::testing {

// The message of the exception that `function` throws; empty where it throws none.
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
