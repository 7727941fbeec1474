// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/config_json.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

namespace plm_vins {
namespace {

TEST(ConfigJson, HasTheNamesGroupsAndTypesOfTheFile) {
  Config config;
  config.file = "mine.yaml";
  config.sensor.cameras[0].parameters.model = CameraParameters::Model::kMei;
  config.sensor.cameras[0].parameters.fx = 500.5;
  config.sensor.cameras[0].parameters.xi = 0.9;
  config.sensor.cameras[0].T_B_C.translation = {1, 2, 3};
  config.estimator.line_anchors = 7;
  config.points.corner_detector = CornerDetectorType::kHarris;
  const Json json = ToJson(config);
  EXPECT_EQ(json["file"], "mine.yaml");
  EXPECT_EQ(json["model_type"], "MEI");
  EXPECT_EQ(json["projection_parameters"]["gamma1"], 500.5);
  EXPECT_EQ(json["mirror_parameters"]["xi"], 0.9);
  EXPECT_EQ(json["extrinsicTranslation"], (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(json["extrinsicRotation"].size(), 9u);
  EXPECT_EQ(json["line_anchors"], 7);
  EXPECT_EQ(json["corner_detector"], "harris");
  EXPECT_EQ(json["loop_closure"], false);
  EXPECT_EQ(json["base_frame"], "");
}

TEST(ConfigJson, HasEveryKey) {
  const Json flat = ToJson(Config()).flatten();
  for (const auto& [name, value] : EffectiveValues(Config())) {
    std::string pointer = "/" + name;
    if (std::holds_alternative<std::vector<double>>(value)) pointer += "/0";
    if (const size_t dot = pointer.find('.'); dot != std::string::npos) pointer[dot] = '/';
    EXPECT_TRUE(flat.contains(pointer)) << pointer;
  }
}

}  // namespace
}  // namespace plm_vins
