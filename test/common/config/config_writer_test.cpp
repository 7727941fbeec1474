// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_writer.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "test/common/config/config_files.h"
#include "test/testing/numeric_jacobian.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

std::string Written(const Config& config) {
  std::ostringstream stream;
  WriteConfig(config, &stream);
  return stream.str();
}

class ConfigWriter : public ::testing::Test {
 protected:
  Config Load(const std::string& name, const std::string& text,
              const std::map<std::string, std::string>& overrides = {}) {
    folder_.Write(name, text);
    return LoadConfig(folder_.File(name), overrides);
  }

  const testing::TemporaryFolder folder_;
};

TEST_F(ConfigWriter, WrittenFileLoadsWithEqualValues) {
  const Config config = Load("camera.yaml", kVinsMonoFile,
                             {{"world_frame", "a\"b\\c:#d"}, {"max_cnt", "77"}, {"equalize", "0"}});
  const Config again = Load("again.yaml", Written(config));
  const auto expected = EffectiveValues(config), values = EffectiveValues(again);
  ASSERT_EQ(values.size(), expected.size());
  for (size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(values[i].first, expected[i].first);
    if (std::holds_alternative<std::vector<double>>(values[i].second)) continue;
    EXPECT_EQ(ToText(values[i].second), ToText(expected[i].second)) << values[i].first;
  }
  EXPECT_MATRIX_NEAR(again.sensor.cameras[0].T_B_C.R(), config.sensor.cameras[0].T_B_C.R(), 1e-11);
  EXPECT_MATRIX_NEAR(again.sensor.cameras[0].T_B_C.translation,
                     config.sensor.cameras[0].T_B_C.translation, 1e-11);
  EXPECT_TRUE(again.warnings.empty());
}

TEST_F(ConfigWriter, HasTheFormatOfOpenCV) {
  const std::string text = Written(Load("camera.yaml", kVinsMonoFile));
  EXPECT_EQ(text.rfind("%YAML:1.0\n", 0), 0u);
  for (const char* part : {"\nimage_topic: \"/cam0/image_raw\"\n",
                           "\nprojection_parameters:\n   fx: 461.6\n   fy: 460.3\n",
                           "\nextrinsicTranslation: !!opencv-matrix\n   rows: 3\n   cols: 1\n   "
                           "dt: d\n   data: [-0.0216401454975, "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST_F(ConfigWriter, ListsTheOverridesAtItsHead) {
  const Config config = Load("camera.yaml", kVinsMonoFile,
                             {{"use_lines", "0"}, {"pose_graph_save_path", "a\nmax_cnt: 9"}});
  EXPECT_EQ(Written(config).rfind(
                "%YAML:1.0\n# From " + config.file +
                    "; values replaced for this run:\n"
                    "#   pose_graph_save_path: a max_cnt: 9\n#   use_lines: 0\nnum_of_cam",
                0),
            0u)
      << Written(config);
  EXPECT_FALSE(Load("again.yaml", Written(config)).use_lines);
}

TEST_F(ConfigWriter, FindsTheMaskFromAnotherFolder) {
  folder_.Write("mask.png", "x");
  const Config config = Load("camera.yaml", std::string(kShortFile) + "fisheye_mask: mask.png\n");
  EXPECT_EQ(Load("other/folder/camera.yaml", Written(config)).points.fisheye_mask,
            folder_.File("mask.png"));
}

}  // namespace
}  // namespace plm_vins
