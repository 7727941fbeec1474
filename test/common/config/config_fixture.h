// SPDX-License-Identifier: BSD-3-Clause
// Loads configurations from texts and checks their problems.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "test/common/config/config_files.h"

namespace plm_vins {

using ConfigOverrides = std::map<std::string, std::string>;

class ConfigTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("plm_vins_config_") + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string Write(const std::string& text) const {
    std::string file = (folder_ / "camera.yaml").string();
    std::ofstream(file) << text;
    return file;
  }

  Config Load(const std::string& text, const ConfigOverrides& overrides = {}) const {
    return LoadConfig(Write(text), overrides);
  }

  std::vector<std::string> ProblemsOf(const std::string& file,
                                      const ConfigOverrides& overrides = {}) const {
    try {
      LoadConfig(file, overrides);
    } catch (const ConfigError& error) {
      return error.problems();
    }
    return {};
  }

  // Expects that the short file with `more` lines has exactly one problem, which contains all
  // `words`.
  void ExpectProblem(const std::string& more, const std::vector<std::string>& words) const {
    ExpectOneProblem(ProblemsOf(Write(kShortFile + more + "\n")), words);
  }

  void ExpectOneProblem(const std::vector<std::string>& problems,
                        const std::vector<std::string>& words) const {
    ASSERT_EQ(problems.size(), 1u) << ConfigError(problems).what();
    for (const std::string& word : words) {
      EXPECT_NE(problems[0].find(word), std::string::npos) << word << " not in: " << problems[0];
    }
  }

  std::filesystem::path folder_;
};

}  // namespace plm_vins
