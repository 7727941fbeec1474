// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/recorder.h"

#include <cv_bridge/cv_bridge.h>
#include <rosbag/bag.h>
#include <rosbag/exceptions.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>

#include <map>
#include <memory>
#include <stdexcept>

#include "common/ros/geometry_conversion.h"
#include "common/ros/names.h"

namespace plm_vins::simulator {
namespace {

// Closes and deletes a bag. A bag that cannot be closed is leaked, since its destructor would close
// it again and terminate the program.
struct CloseOrLeave {
  void operator()(rosbag::Bag* bag) const {
    try {
      bag->close();
      delete bag;
    } catch (const rosbag::BagException&) {
    }
  }
};

class BagRecorder : public Recorder {
 public:
  BagRecorder(const std::string& file, const SensorConfig& sensors)
      : file_(file), sensors_(sensors) {
    Guard([&] { bag_->open(file, rosbag::bagmode::Write); });
  }

  void Write(const ImuSample& sample) override {
    sensor_msgs::Imu message;
    message.header = NextHeader(sample.t_ns, "imu0", &imu_count_);
    message.orientation_covariance[0] = -1;  // marks the orientation as not available
    message.angular_velocity = ToVector3(sample.gyro);
    message.linear_acceleration = ToVector3(sample.accel);
    Guard([&] { bag_->write(AbsoluteTopic(sensors_.imu_topic), message.header.stamp, message); });
  }

  void WriteImage(int camera, const ImageSample& image) override {
    const std::string frame = "cam" + std::to_string(camera);
    WritePixels(sensors_.cameras.at(camera).image_topic,
                NextHeader(image.t_ns, frame, &image_counts_[camera]), "mono8", image.gray);
  }

  void WriteDepth(int64_t t_ns, const cv::Mat1w& depth) override {
    WritePixels(sensors_.depth.value().topic, NextHeader(t_ns, "cam0", &depth_count_), "16UC1",
                depth);
  }

  void Finish() override {
    rosbag::Bag* bag = bag_.release();  // a bag that cannot be closed must not be closed again
    Guard([bag] {
      bag->close();
      delete bag;
    });
  }

 private:
  static std_msgs::Header NextHeader(int64_t t_ns, const std::string& frame_id, uint32_t* count) {
    std_msgs::Header header;
    header.seq = (*count)++;
    header.stamp = ToRosTime(t_ns);
    header.frame_id = frame_id;
    return header;
  }

  void WritePixels(const std::string& topic, const std_msgs::Header& header,
                   const std::string& encoding, const cv::Mat& pixels) {
    const auto message = cv_bridge::CvImage(header, encoding, pixels).toImageMsg();
    Guard([&] { bag_->write(AbsoluteTopic(topic), header.stamp, message); });
  }

  template <typename Action>
  void Guard(Action action) const {
    try {
      action();
    } catch (const rosbag::BagException& error) {
      throw std::runtime_error("cannot write " + file_ + ": " + error.what());
    }
  }

  std::string file_;
  SensorConfig sensors_;
  std::unique_ptr<rosbag::Bag, CloseOrLeave> bag_{new rosbag::Bag};
  uint32_t imu_count_ = 0, depth_count_ = 0;
  std::map<int, uint32_t> image_counts_;  // by camera
};

}  // namespace

std::unique_ptr<Recorder> MakeBagRecorder(const std::string& file, const SensorConfig& sensors) {
  return std::make_unique<BagRecorder>(file, sensors);
}

}  // namespace plm_vins::simulator
