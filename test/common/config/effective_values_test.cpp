// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "common/config/config.h"
#include "common/config/config_keys.h"
#include "test/common/config/config_files.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

Config Load(const testing::TemporaryFolder& folder, const std::string& text,
            const std::map<std::string, std::string>& overrides = {}) {
  folder.Write("camera.yaml", text);
  return LoadConfig(folder.File("camera.yaml"), overrides);
}

using Values = std::map<std::string, ConfigValue>;

Values ValuesOf(const Config& config) {
  const auto values = EffectiveValues(config);
  return Values(values.begin(), values.end());
}

TEST(EffectiveValues, HoldEveryKey) {
  const testing::TemporaryFolder folder;
  const Config config =
      Load(folder, kVinsMonoFile, {{"line_anchors", "7"}, {"estimate_extrinsic", "2"}});
  const Values values = ValuesOf(config);
  Config other;
  EXPECT_EQ(values.size(), AllKeys({"PINHOLE"}, &other).size());
  EXPECT_EQ(values.at("image_topic"), ConfigValue(std::string("/cam0/image_raw")));
  EXPECT_EQ(values.at("projection_parameters.fx"), ConfigValue(461.6));
  EXPECT_EQ(values.at("line_anchors"), ConfigValue(7));
  EXPECT_EQ(values.at("estimate_extrinsic"), ConfigValue(2));
  EXPECT_EQ(values.at("line_detector"), ConfigValue(std::string("fld")));
  EXPECT_EQ(values.at("publish_tf"), ConfigValue(true));
  EXPECT_EQ(values.at("gyr_n"), ConfigValue(config.sensor.imu_noise.gyro_density));
  EXPECT_EQ(values.at("imu_noise_model"), ConfigValue(std::string("continuous")));
  const auto R_B_C = std::get<std::vector<double>>(values.at("extrinsicRotation"));
  ASSERT_EQ(R_B_C.size(), 9u);
  EXPECT_NEAR(R_B_C[1], -0.999880929698, 1e-9);
  EXPECT_NEAR(R_B_C[3], 0.999557249008, 1e-9);
}

// A configuration as of VINS-Mono: noise of samples, a mask without folder, the fisheye model by
// its old name.
TEST(EffectiveValues, RoundTripThroughAFile) {
  const testing::TemporaryFolder folder;
  folder.Write("mask.png", "x");
  std::string text = Replaced(kShortFile, "PINHOLE", "KANNALA_BRANDT");
  text = Replaced(text, "fx: 400, fy: 400, cx: 320, cy: 240}",
                  "k2: 0.1, k3: 0.2, k4: 0.3, k5: 0.4, mu: 380, mv: 381, u0: 310, v0: 230}");
  text = Replaced(text, "distortion_parameters: {k1: 0, k2: 0, p1: 0, p2: 0}\n", "");
  const Config config =
      Load(folder, text +
                       "fisheye_mask: mask.png\nacc_n: 0.1\ngyr_n: 0.01\nacc_w: 0.001\n"
                       "gyr_w: 0.0001\nimu_rate: 400\nmax_line_cnt: 33\n");
  std::string again;
  for (const auto& [name, value] : ValuesOf(config)) {
    const bool is_matrix = std::holds_alternative<std::vector<double>>(value);
    if (!is_matrix) again += name + ": " + ToText(value) + "\n";
  }
  const Config same = Load(folder, again);
  const Values expected = ValuesOf(config);
  for (const auto& [name, value] : ValuesOf(same)) {
    EXPECT_EQ(ToText(value), ToText(expected.at(name))) << name;  // to twelve digits
  }
}

}  // namespace
}  // namespace plm_vins
