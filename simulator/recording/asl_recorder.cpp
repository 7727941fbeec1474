// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/asl_recorder.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "simulator/recording/csv_row.h"

namespace plm_vins::simulator {
namespace {

std::string MakeFolder(const std::string& folder) {
  if (std::filesystem::exists(folder + "/mav0")) {
    throw std::runtime_error(folder + " already holds a recording; remove it or choose another");
  }
  for (const char* part : {"/mav0/imu0", "/mav0/state_groundtruth_estimate0"}) {
    std::filesystem::create_directories(folder + part);
  }
  return folder + "/mav0";
}

std::string MakePictureFolder(const std::string& folder) {
  std::filesystem::create_directories(folder + "/data");
  return folder;
}

}  // namespace

AslRecorder::Pictures::Pictures(const std::string& folder)
    : folder_(MakePictureFolder(folder)), list_(folder + "/data.csv") {
  list_.stream() << "#timestamp [ns],filename\n";
}

void AslRecorder::Pictures::Add(int64_t t_ns, const cv::Mat& picture) {
  const std::string name = std::to_string(t_ns) + ".png", file = folder_ + "/data/" + name;
  // Sensor noise hardly compresses: the fastest level is nearly the smallest.
  if (!cv::imwrite(file, picture, {cv::IMWRITE_PNG_COMPRESSION, 1})) {
    throw std::runtime_error("cannot write " + file);
  }
  list_.stream() << t_ns << ',' << name << '\n';
}

AslRecorder::AslRecorder(const std::string& folder)
    : folder_(MakeFolder(folder)), imu_list_(folder_ + "/imu0/data.csv") {
  imu_list_.stream()
      << "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
         "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";
}

void AslRecorder::Write(const ImuSample& sample) {
  imu_list_.stream() << CsvRow(sample.t_ns, {sample.gyro.x(), sample.gyro.y(), sample.gyro.z(),
                                             sample.accel.x(), sample.accel.y(), sample.accel.z()});
}

void AslRecorder::WriteImage(int camera, const ImageSample& image) {
  const auto pictures = images_.try_emplace(camera, folder_ + "/cam" + std::to_string(camera));
  pictures.first->second.Add(image.t_ns, image.gray);
}

void AslRecorder::WriteDepth(int64_t t_ns, const cv::Mat1w& depth) {
  if (!depths_) depths_.emplace(folder_ + "/depth0");
  depths_->Add(t_ns, depth);
}

void AslRecorder::Finish() {
  for (auto& [camera, pictures] : images_) pictures.Close();
  if (depths_) depths_->Close();
  imu_list_.Close();
}

std::string AslRecorder::GroundTruthFile(const std::string& folder) {
  return folder + "/mav0/state_groundtruth_estimate0/data.csv";
}

}  // namespace plm_vins::simulator
