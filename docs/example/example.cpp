// SPDX-License-Identifier: BSD-3-Clause
// Feeds images and IMU samples to the trackers and the estimator, without ROS. Usage: example
// CONFIG
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "common/config/config.h"
#include "feature_tracker/point_tracking_stage.h"
#include "vins_estimator/estimation_stage.h"

int main(int, char** argv) {
  using namespace plm_vins;
  const Config config = LoadConfig(argv[1]);
  PointTrackingStage tracker(config);
  EstimationStage estimator(config);
  const CameraParameters& camera = config.sensor.cameras[0].parameters;
  cv::Mat gray(camera.height, camera.width, CV_8UC1);  // replace by the images of your camera
  cv::randu(gray, 0, 255);
  cv::GaussianBlur(gray, gray, {}, 3);
  for (int64_t t_ns = 0; t_ns < 2'000'000'000; t_ns += 5'000'000) {  // 2 s at 200 Hz
    ImuSample imu;  // replace by the samples of your IMU
    imu.t_ns = t_ns;
    imu.accel.z() = config.sensor.gravity_norm;
    tracker.AddImu(imu);
    estimator.AddImu(imu);
    if (t_ns % 50'000'000 == 0) tracker.AddImage(0, {t_ns, gray.clone()});
    while (auto tracked = tracker.Pop()) estimator.AddPoints(tracked->features);
    while (auto estimate = estimator.Pop()) {
      if (!estimate->output.has_pose) continue;
      const Eigen::Vector3d p_W = estimate->output.state.position();
      std::printf("%.3f s: %.4f %.4f %.4f m\n", ToSeconds(estimate->output.state.t_ns), p_W.x(),
                  p_W.y(), p_W.z());
    }
  }
}
