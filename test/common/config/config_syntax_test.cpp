// SPDX-License-Identifier: BSD-3-Clause
// Messages about files that are not YAML, or more than one document.
#include <gtest/gtest.h>

#include <string>

#include "test/common/config/config_fixture.h"

namespace plm_vins {
namespace {

using ConfigSyntax = ConfigTest;

TEST_F(ConfigSyntax, ErrorsNameTheLineAndCommonMistakes) {
  const std::string what = "not valid YAML";
  const std::string hint = "check this line and the one before it: indentation by spaces";
  ExpectOneProblem(ProblemsOf(Write("%YAML:1.0\nimage_width: 752\nimu_topic: [1, 2\nx: 3\n")),
                   {"camera.yaml:4", what, hint});
  ExpectOneProblem(ProblemsOf(Write("%YAML:1.0\ngroup:\n\tk1: 0\nx: 3\n")),
                   {"camera.yaml:3", what, hint});
  ExpectProblem("max_cnt:100\nmin_dist: 30", {"camera.yaml:11", what, hint});
  ExpectProblem("mirror_parameters:\n   xi: 1\n     x: 2", {"camera.yaml:12", what, hint});
}

TEST_F(ConfigSyntax, ASecondDocumentIsRejected) {
  for (const std::string separator : {"---", "..."}) {
    ExpectProblem(separator + "\nmax_cnt: 100",
                  {"camera.yaml:1", "not valid YAML: a second document begins; remove the line"});
  }
}

// A comment that continues on a line of its own.
TEST_F(ConfigSyntax, ACommaInPlaceOfAKeyIsRejected) {
  ExpectOneProblem(ProblemsOf(Write("%YAML:1.0\n# at most 3\n, or less\nx: 3\n")),
                   {"camera.yaml:3: not valid YAML: a key or value is missing"});
}

TEST_F(ConfigSyntax, FilesOfKalibrAreToBeConverted) {
  const std::string noise = "rostopic: /imu0\naccelerometer_noise_density: 0.01\n";
  const std::string nested = "imu0:\n  accelerometers:\n    M: [1]\n";
  for (const std::string& text :
       {std::string("cam0:\n  camera_model: pinhole\n"), noise, nested,
        std::string("use_fej: true\nrelative_config_imu: \"kalibr_imu_chain.yaml\"\n")}) {
    ExpectOneProblem(ProblemsOf(Write("%YAML:1.0\n" + text)),
                     {"camera.yaml: is a file of Kalibr or OpenVINS; convert it with "
                      "kalibr_to_config.py"});
  }
}

TEST_F(ConfigSyntax, AcceptsDocumentMarkersAroundOneDocument) {
  const std::string text = Replaced(kShortFile, "%YAML:1.0\n", "%YAML:1.0\n---\n");
  for (const std::string end : {"", "...\n", "---\n"}) {
    EXPECT_EQ(Load(text + end).sensor.cameras[0].image_topic, "/image");
  }
}

}  // namespace
}  // namespace plm_vins
