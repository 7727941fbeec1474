// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/asl_recording.h"

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <system_error>

#include "common/append.h"
#include "common/io/grey_image.h"
#include "offline/recordings/sorted_rows.h"

namespace plm_vins {
namespace {

namespace fs = std::filesystem;

std::optional<ImuSample> ToImuSample(const CsvRow& row) {
  double values[6];
  for (int i = 0; i < 6; ++i) {
    char* end = nullptr;
    values[i] = std::strtod(row.values[i].c_str(), &end);
    if (end == row.values[i].c_str() || *end != '\0') return std::nullopt;
  }
  return ImuSample{row.t_ns, Eigen::Vector3d(values), Eigen::Vector3d(values + 3)};
}

// Returns an empty image if the file cannot be read.
cv::Mat ReadImage(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return {};  // avoids a warning of OpenCV
  try {
    return cv::imread(file.string(), kReadGreyAsStored);
  } catch (const cv::Exception&) {  // a damaged header may claim too many pixels for OpenCV
    return {};
  }
}

std::string Require(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw std::runtime_error("not an ASL folder: " + file.string() +
                             (error ? ": " + error.message() : " is missing"));
  }
  return file.string();
}

fs::path SensorRoot(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error("cannot read the folder " + folder + ": " +
                             (error ? error.message() : "not a folder"));
  }
  const fs::path nested = fs::path(folder) / "mav0";
  return fs::is_directory(nested, error) ? nested : fs::path(folder);
}

struct ImageRow {
  int64_t t_ns = 0;
  std::string file;
};

std::optional<ImageRow> ToImageRow(const CsvRow& row) { return ImageRow{row.t_ns, row.values[0]}; }

constexpr SortedRows<ImageRow>::Format kImageFormat = {"image", "image", "stamp [ns],file name", 1,
                                                       ToImageRow};
constexpr SortedRows<ImuSample>::Format kImuFormat = {
    "imu", "IMU sample", "stamp [ns],gyro x,y,z [rad/s],accelerometer x,y,z [m/s^2]", 6,
    ToImuSample};

// Merges the two csv files by timestamp; an IMU sample precedes an image of the same time.
class AslRecording : public Recording {
 public:
  explicit AslRecording(const std::string& folder)
      : name_(folder),
        image_folder_(SensorRoot(folder) / "cam0" / "data"),
        images_(Require(SensorRoot(folder) / "cam0" / "data.csv"), kImageFormat),
        imu_(Require(SensorRoot(folder) / "imu0" / "data.csv"), kImuFormat) {}

  std::optional<RecordingEvent> Next() override {
    const ImageRow* image = images_.next();
    const ImuSample* sample = imu_.next();
    if (sample != nullptr && (image == nullptr || sample->t_ns <= image->t_ns)) {
      return RecordingEvent{RecordingEvent::Kind::kImu, sample->t_ns, imu_.Take()};
    }
    if (image == nullptr) return std::nullopt;
    current_image_ = image_folder_ / images_.Take().file;
    return RecordingEvent{RecordingEvent::Kind::kImage, image->t_ns, {}};
  }

  std::optional<cv::Mat> LoadImage() override {
    cv::Mat gray = ReadImage(current_image_);
    if (!gray.empty()) return gray;
    unreadable_images_.Add(current_image_.string());
    return std::nullopt;
  }

  std::string name() const override { return name_; }
  std::string Source(RecordingEvent::Kind kind) const override {
    return kind == RecordingEvent::Kind::kImage ? images_.file() : imu_.file();
  }
  std::optional<int64_t> end_ns() const override { return images_.end_ns(); }

  DropCounts problems() const override {
    DropCounts counts = {unreadable_images_};
    Append(images_.problems(), &counts);
    Append(imu_.problems(), &counts);
    return counts;
  }

 private:
  std::string name_;
  fs::path image_folder_;
  SortedRows<ImageRow> images_;
  SortedRows<ImuSample> imu_;
  fs::path current_image_;
  DropCount unreadable_images_{"images_unreadable", 0, ""};
};

}  // namespace

std::unique_ptr<Recording> OpenAslFolder(const std::string& folder) {
  return std::make_unique<AslRecording>(folder);
}

}  // namespace plm_vins
