// SPDX-License-Identifier: BSD-3-Clause
// Messages about files that are not YAML, or more than one document.
#include <gtest/gtest.h>

#include <string>

#include "test/common/config/config_fixture.h"

namespace plm_vins {
namespace {

using ConfigSyntax = ConfigTest;

TEST_F(ConfigSyntax, ErrorsNameTheLine) {
  ExpectOneProblem(ProblemsOf(Write("%YAML:1.0\nimage_width: 752\nimu_topic: [1, 2\nx: 3\n")),
                   {"camera.yaml:4", "not valid YAML"});
}

TEST_F(ConfigSyntax, ATabInTheIndentationIsNamed) {
  for (const std::string indentation : {"\t", "  \t"}) {
    ExpectOneProblem(ProblemsOf(Write("%YAML:1.0\ngroup:\n" + indentation + "k1: 0\nx: 3\n")),
                     {"camera.yaml:3", "look at line 3: it is indented by a tab, use spaces"});
  }
}

TEST_F(ConfigSyntax, AMissingSpaceIsNamed) {
  ExpectProblem("max_cnt:100\nmin_dist: 30",
                {"camera.yaml:11", "look at line 10: a space is missing after the colon"});
  ExpectProblem("mirror_parameters:\n   xi:1\n   x: 2", {"look at line 11: a space is missing"});
}

TEST_F(ConfigSyntax, UnequalIndentationIsNamed) {
  for (const std::string group : {"   xi: 1\n     x: 2", "   xi: 1\n  x: 2"}) {
    ExpectProblem("mirror_parameters:\n" + group,
                  {"camera.yaml:12", "are the keys of each group indented alike"});
  }
}

TEST_F(ConfigSyntax, ASecondDocumentIsRefused) {
  for (const std::string separator : {"---", "..."}) {
    ExpectProblem(separator + "\nmax_cnt: 100",
                  {"camera.yaml:11: a second YAML document begins; remove the line"});
  }
}

TEST_F(ConfigSyntax, OneDocumentMayBeginAndEndAsYamlHasIt) {
  const std::string text = Replaced(kShortFile, "%YAML:1.0\n", "%YAML:1.0\n---\n");
  for (const std::string end : {"", "...\n", "---\n"}) {
    EXPECT_EQ(Load(text + end).sensor.image_topic, "/image");
  }
}

}  // namespace
}  // namespace plm_vins
