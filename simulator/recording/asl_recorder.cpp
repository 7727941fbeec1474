// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/asl_recorder.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "simulator/recording/csv_row.h"

namespace plm_vins::simulator {
namespace {

std::string MakeFolders(const std::string& folder) {
  if (std::filesystem::exists(folder + "/mav0")) {
    throw std::runtime_error(folder + " holds a recording already: remove it or choose another");
  }
  for (const char* part : {"/mav0/cam0/data", "/mav0/imu0", "/mav0/state_groundtruth_estimate0"}) {
    std::filesystem::create_directories(folder + part);
  }
  return folder + "/mav0";
}

}  // namespace

AslRecorder::AslRecorder(const std::string& folder)
    : image_folder_(MakeFolders(folder) + "/cam0/data/"),
      image_list_(folder + "/mav0/cam0/data.csv"),
      imu_list_(folder + "/mav0/imu0/data.csv") {
  image_list_.stream() << "#timestamp [ns],filename\n";
  imu_list_.stream()
      << "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
         "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";
}

void AslRecorder::Write(const ImuSample& sample) {
  imu_list_.stream() << CsvRow(sample.t_ns, {sample.gyro.x(), sample.gyro.y(), sample.gyro.z(),
                                             sample.accel.x(), sample.accel.y(), sample.accel.z()});
}

void AslRecorder::Write(const ImageSample& image) {
  const std::string name = std::to_string(image.t_ns) + ".png";
  // Sensor noise is hardly compressible, so the fastest level is nearly the smallest.
  if (!cv::imwrite(image_folder_ + name, image.gray, {cv::IMWRITE_PNG_COMPRESSION, 1})) {
    throw std::runtime_error("cannot write " + image_folder_ + name);
  }
  image_list_.stream() << image.t_ns << ',' << name << '\n';
}

void AslRecorder::Finish() {
  image_list_.Close();
  imu_list_.Close();
}

std::string AslRecorder::GroundTruthFile(const std::string& folder) {
  return folder + "/mav0/state_groundtruth_estimate0/data.csv";
}

}  // namespace plm_vins::simulator
