// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/asl_recording.h"

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "common/append.h"
#include "common/io/gray_image.h"
#include "offline/recordings/csv_reader.h"

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
cv::Mat ReadImage(const fs::path& file, int flags) {
  std::error_code error;
  if (!fs::exists(file, error)) return {};  // avoids a warning of OpenCV
  try {
    return cv::imread(file.string(), flags);
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

// `key` names the sensor in reports.
constexpr SortedRows<ImageRow>::Format ImageFormat(const char* key) {
  return {key, "image", "stamp [ns],file name", 1, ToImageRow};
}
constexpr SortedRows<ImuSample>::Format kImuFormat = {
    "imu", "IMU sample", "stamp [ns],gyro x,y,z [rad/s],accelerometer x,y,z [m/s^2]", 6,
    ToImuSample};

// The images of one folder: "cam0", "cam1", ... or "depth0".
struct ImageStream {
  RecordingEvent event;  // without timestamp
  fs::path folder;
  SortedRows<ImageRow> rows;

  ImageStream(const RecordingEvent& kind_of_event, const fs::path& root, const std::string& name,
              const char* key)
      : event(kind_of_event),
        folder(root / name / "data"),
        rows(Require(root / name / "data.csv"), ImageFormat(key)) {}
};

// Merges the csv files by timestamp. At the same time, IMU samples come first and cam0 last.
class AslRecording : public Recording {
 public:
  AslRecording(const std::string& folder, int cameras, bool with_depth)
      : name_(folder), imu_(Require(SensorRoot(folder) / "imu0" / "data.csv"), kImuFormat) {
    using Kind = RecordingEvent::Kind;
    const fs::path root = SensorRoot(folder);
    const RecordingEvent depth{Kind::kDepth, 0, {}};
    if (with_depth) images_.emplace_back(depth, root, "depth0", "depth_image");
    constexpr const char* kKeys[kMaxCameras] = {"image", "camera1_image", "camera2_image",
                                                "camera3_image"};
    for (int camera = cameras - 1; camera >= 0; --camera) {
      const RecordingEvent event{Kind::kImage, 0, {}, camera};
      images_.emplace_back(event, root, "cam" + std::to_string(camera), kKeys[camera]);
    }
  }

  std::optional<RecordingEvent> Next() override {
    ImageStream* earliest = nullptr;
    for (ImageStream& stream : images_) {
      if (stream.rows.next() == nullptr) continue;
      if (earliest == nullptr || stream.rows.next()->t_ns < earliest->rows.next()->t_ns) {
        earliest = &stream;
      }
    }
    const ImuSample* sample = imu_.next();
    if (sample != nullptr && (earliest == nullptr || sample->t_ns <= earliest->rows.next()->t_ns)) {
      return RecordingEvent{RecordingEvent::Kind::kImu, sample->t_ns, imu_.Take()};
    }
    if (earliest == nullptr) return std::nullopt;
    const ImageRow& row = earliest->rows.Take();
    current_ = earliest;
    current_image_ = earliest->folder / row.file;
    RecordingEvent event = earliest->event;
    event.t_ns = row.t_ns;
    return event;
  }

  std::optional<cv::Mat> LoadImage() override {
    const bool is_depth = current_->event.kind == RecordingEvent::Kind::kDepth;
    cv::Mat image = ReadImage(current_image_, is_depth ? cv::IMREAD_UNCHANGED : kReadGrayAsStored);
    if (!image.empty()) return image;
    unreadable_images_.Add(current_image_.string());
    return std::nullopt;
  }

  std::string name() const override { return name_; }
  std::string Source(RecordingEvent::Kind kind) const override {
    if (kind == RecordingEvent::Kind::kImu) return imu_.file();
    return kind == RecordingEvent::Kind::kImage ? camera_rows().file()
                                                : images_.front().rows.file();
  }
  std::optional<int64_t> end_ns() const override { return camera_rows().end_ns(); }

  DropCounts problems() const override {
    DropCounts counts = {unreadable_images_};
    for (const ImageStream& stream : images_) Append(stream.rows.problems(), &counts);
    Append(imu_.problems(), &counts);
    return counts;
  }

 private:
  const SortedRows<ImageRow>& camera_rows() const { return images_.back().rows; }

  std::string name_;
  std::vector<ImageStream> images_;  // the last is cam0
  SortedRows<ImuSample> imu_;
  const ImageStream* current_ = nullptr;  // of the event that was returned last
  fs::path current_image_;
  DropCount unreadable_images_{"images_unreadable", 0, ""};
};

}  // namespace

std::unique_ptr<Recording> OpenAslFolder(const std::string& folder, int cameras, bool with_depth) {
  return std::make_unique<AslRecording>(folder, cameras, with_depth);
}

}  // namespace plm_vins
