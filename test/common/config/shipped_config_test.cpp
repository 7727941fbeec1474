// SPDX-License-Identifier: BSD-3-Clause
// Tests of the configuration files in the package.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "common/config/config_entry.h"
#include "common/config/config_keys.h"

namespace plm_vins {
namespace {

namespace fs = std::filesystem;

TEST(ShippedConfig, EveryFileLoads) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(CONFIG_DIR)) {
    if (entry.path().extension() != ".yaml") continue;
    ++files;
    EXPECT_NO_THROW({
      const Config config = LoadConfig(entry.path().string());
      EXPECT_TRUE(config.warnings.empty());
    }) << entry.path();
  }
  EXPECT_GE(files, 2);
}

TEST(ShippedConfig, EurocRadtanHasTheCalibrationOfTheDataset) {
  const Config config = LoadConfig(CONFIG_DIR "/euroc_radtan.yaml");
  EXPECT_EQ(config.sensor.cameras[0].parameters.fx, 458.654);
  EXPECT_EQ(config.sensor.cameras[0].T_B_C.translation.x(), -0.0216401454975);
  EXPECT_EQ(config.sensor.imu_noise.accel_walk, 3.0e-3);
  EXPECT_EQ(config.publish_rate, 0);
}

// Unit ray through a pixel in the IMU frame.
Eigen::Vector3d BodyRay(const Config& config, const Eigen::Vector2d& pixel) {
  const auto camera = CameraModel::Create(config.sensor.cameras[0].parameters);
  const Eigen::Vector3d ray = camera->Unproject(pixel).value().homogeneous().normalized();
  return config.sensor.cameras[0].T_B_C.rotation * ray;
}

// T_B_C depends on the lens: two calibrations of one camera give nearly the same rays.
TEST(ShippedConfig, BothCalibrationsOfEurocGiveSimilarRays) {
  const Config equidistant = LoadConfig(CONFIG_DIR "/euroc.yaml");
  const Config radtan = LoadConfig(CONFIG_DIR "/euroc_radtan.yaml");
  EXPECT_EQ(equidistant.sensor.cameras[0].parameters.model,
            CameraParameters::Model::kPinholeEquidistant);
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(376, 240), {150, 100}, {600, 400}}) {
    const double angle = std::acos(BodyRay(equidistant, pixel).dot(BodyRay(radtan, pixel)));
    EXPECT_LT(angle, 0.3 * M_PI / 180) << pixel.transpose();
  }
}

class ReferenceFile : public ::testing::Test {
 protected:
  ReferenceFile() {
    std::ifstream stream(kFile);
    for (std::string line; std::getline(stream, line);) lines_.push_back(line);
    std::vector<std::string> problems;
    entries_ = ReadConfigEntries(kFile, {}, "", &problems).value();
  }

  // Returns the comment on the line of a key.
  std::string CommentOn(const std::string& key) const {
    const std::string& location = entries_.at(key).location;  // FILE:LINE
    const std::string& line = lines_.at(std::stoul(location.substr(location.rfind(':') + 1)) - 1);
    return line.substr(std::min(line.find('#'), line.size()));
  }

  // Returns whether the key has a unit: numbers and matrices do, flags, choices and texts do not.
  static bool IsMeasured(const ConfigKey& key) {
    const ConfigValue value = key.value();
    return std::holds_alternative<double>(value) ||
           std::holds_alternative<std::vector<double>>(value) ||
           key.allowed.find(" to ") != std::string::npos;
  }

  static constexpr const char* kFile = CONFIG_DIR "/reference.yaml";
  std::vector<std::string> lines_;
  ConfigEntries entries_;
};

TEST_F(ReferenceFile, HasAllKeysAndNoOthers) {
  std::vector<std::string> known, documented;
  Config config;
  for (const auto& key : AllKeys({"PINHOLE"}, &config)) known.push_back(key.name);
  for (const auto& [name, entry] : entries_) documented.push_back(name);
  EXPECT_THAT(documented, ::testing::UnorderedElementsAreArray(known));
}

TEST_F(ReferenceFile, StatesUnitRangeAndDefault) {
  Config config;
  for (const auto& key : AllKeys({"PINHOLE"}, &config)) {
    const std::string unit =
        IsMeasured(key) ? "[" + (key.unit.empty() ? "1" : key.unit) + "], " : "";
    const std::string comment = CommentOn(key.name);
    EXPECT_NE(comment.find(unit + key.allowed), std::string::npos) << key.name << ": " << comment;
    const std::string standard = "default " + ToText(key.value());
    const size_t found = (comment + " ").find(standard);
    EXPECT_EQ(found != std::string::npos, key.has_default) << key.name << ": " << comment;
    if (!key.has_default) continue;
    const char next = (comment + " ").at(found + standard.size());
    EXPECT_NE(std::string(" ,;:").find(next), std::string::npos) << key.name << ": " << comment;
  }
}

TEST_F(ReferenceFile, HasTheDefaultsAsValues) {
  Config config;
  for (const auto& key : AllKeys({"PINHOLE"}, &config)) {
    // The noise values are densities; there is no mask.
    if (key.name == "imu_noise_model" || key.name == "fisheye" || !key.has_default) continue;
    const std::string value = entries_.at(key.name).value.Scalar();
    EXPECT_EQ(ToText(ConfigValue(value)), ToText(key.value())) << key.name;
  }
}

TEST_F(ReferenceFile, NamesTheKeysOfTheOtherCameraModels) {
  std::string comments;
  for (const std::string& line : lines_) {
    if (line.rfind('#', 0) == 0) comments += line + " ";
  }
  for (const char* model_type : {"EQUIDISTANT", "KANNALA_BRANDT", "MEI"}) {
    EXPECT_NE(comments.find(std::string("# ") + model_type + " "), std::string::npos);
    Config config;
    for (const auto& key : AllKeys({model_type}, &config)) {
      if (key.name.find('.') == std::string::npos) continue;
      const std::string last_part = key.name.substr(key.name.find('.') + 1);
      EXPECT_NE(comments.find(last_part), std::string::npos) << key.name;
    }
  }
}

TEST_F(ReferenceFile, NamesTheKeysOfTheOtherCameras) {
  std::string comments;
  for (const std::string& line : lines_) {
    if (line.rfind('#', 0) == 0) comments += line + " ";
  }
  Config config;
  for (const auto& key : AllKeys({"PINHOLE", "MEI"}, &config)) {
    const std::string name = key.name.substr(0, key.name.find('.'));
    EXPECT_TRUE(entries_.count(key.name) > 0 || comments.find(name) != std::string::npos) << name;
  }
}

}  // namespace
}  // namespace plm_vins
