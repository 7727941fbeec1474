// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/asl_recording.h"

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <system_error>

#include "offline/recordings/csv_reader.h"
#include "offline/recordings/ordered_rows.h"

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

// Empty where it cannot be read.
cv::Mat ReadImage(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return {};  // without OpenCV's own warning
  try {
    return cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {  // a damaged header may ask for more pixels than OpenCV allows
    return {};
  }
}

std::string Require(const fs::path& file) {
  if (!fs::exists(file)) {
    throw std::runtime_error("not an ASL folder: " + file.string() + " is missing");
  }
  return file.string();
}

fs::path SensorRoot(const std::string& folder) {
  if (!fs::is_directory(folder)) throw std::runtime_error("no such folder: " + folder);
  const fs::path nested = fs::path(folder) / "mav0";
  return fs::is_directory(nested) ? nested : fs::path(folder);
}

// The two csv files merged by stamp; an IMU sample comes before an image of the same time.
class AslRecording : public Recording {
 public:
  explicit AslRecording(const std::string& folder)
      : name_(folder),
        image_folder_(SensorRoot(folder) / "cam0" / "data"),
        image_rows_(Require(SensorRoot(folder) / "cam0" / "data.csv"), 1),
        imu_rows_(Require(SensorRoot(folder) / "imu0" / "data.csv"), 6),
        end_ns_(LastStamp(SensorRoot(folder) / "cam0" / "data.csv")) {
    next_image_ = ordered_images_.Next();
    next_imu_ = ordered_imu_.Next();
    if (!next_image_) throw std::runtime_error("no image listed in " + folder + " (cam0/data.csv)");
    if (!next_imu_) throw std::runtime_error("no IMU sample in " + folder + " (imu0/data.csv)");
  }

  std::optional<RecordingEvent> Next() override {
    RecordingEvent event;
    if (next_imu_ && (!next_image_ || next_imu_->t_ns <= next_image_->t_ns)) {
      event = {RecordingEvent::Kind::kImu, next_imu_->t_ns, *next_imu_};
      next_imu_ = ordered_imu_.Next();
    } else if (next_image_) {
      event = {RecordingEvent::Kind::kImage, next_image_->t_ns, {}};
      current_image_ = image_folder_ / next_image_->values[0];
      next_image_ = ordered_images_.Next();
    } else {
      return std::nullopt;
    }
    return event;
  }

  std::optional<cv::Mat> LoadImage() override {
    cv::Mat gray = ReadImage(current_image_);
    if (!gray.empty()) return gray;
    unreadable_images_.Add(current_image_.string());
    return std::nullopt;
  }

  std::string name() const override { return name_; }
  std::optional<int64_t> end_ns() const override { return end_ns_; }

  DropCounts problems() const override {
    return {unreadable_images_,
            {"image_csv_lines_bad", image_rows_.bad_lines(), image_rows_.first_bad_line()},
            {"imu_csv_lines_bad", imu_rows_.bad_lines(), imu_rows_.first_bad_line()},
            {"image_stamps_ahead_of_time", ordered_images_.dropped(), ""},
            {"imu_stamps_ahead_of_time", ordered_imu_.dropped(), ""}};
  }

 private:
  static std::optional<int64_t> LastStamp(const fs::path& file) {
    CsvReader reader(file.string(), 1);
    OrderedRows<CsvRow> rows([&reader] { return reader.Next(); });
    std::optional<int64_t> last;
    while (const auto row = rows.Next()) last = row->t_ns;
    return last;
  }

  std::optional<ImuSample> NextImu() {
    while (const auto row = imu_rows_.Next()) {
      if (auto sample = ToImuSample(*row)) return sample;
      imu_rows_.Reject();
    }
    return std::nullopt;
  }

  std::string name_;
  fs::path image_folder_;
  CsvReader image_rows_;
  CsvReader imu_rows_;
  OrderedRows<CsvRow> ordered_images_{[this] { return image_rows_.Next(); }};
  OrderedRows<ImuSample> ordered_imu_{[this] { return NextImu(); }};
  std::optional<int64_t> end_ns_;
  std::optional<CsvRow> next_image_;
  std::optional<ImuSample> next_imu_;
  fs::path current_image_;
  DropCount unreadable_images_{"images_unreadable", 0, ""};
};

}  // namespace

std::unique_ptr<Recording> OpenAslFolder(const std::string& folder) {
  return std::make_unique<AslRecording>(folder);
}

}  // namespace plm_vins
