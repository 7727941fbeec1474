// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/camera_simulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/camera/camera_model.h"
#include "simulator/default_sensors.h"

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

constexpr int kMiddleRow = 240;

// The camera is mounted without rotation: V looks along x, C along z.
struct Rig {
  SensorConfig sensors = DefaultSensors();
  TrajectoryOptions options;

  explicit Rig(Motion motion) {
    options.motion = motion;
    options.duration = 12.0;
    options.R_V_B = ForwardLookingBody(sensors.cameras[0].T_B_C);
  }
};

// A wall 4 m ahead of the trajectory's box, whose left half (y > 0) is bright.
Scene HalfBrightWall() {
  Scene scene;
  const int bright = scene.AddTexture(cv::Mat1b(2, 2, uchar(200)), 1, 1);
  const int dark = scene.AddTexture(cv::Mat1b(2, 2, uchar(20)), 1, 1);
  scene.AddRectangle({{6, 30, -30}, -Vector3d::UnitY(), Vector3d::UnitZ(), 30, 60, bright});
  scene.AddRectangle({{6, 0, -30}, -Vector3d::UnitY(), Vector3d::UnitZ(), 30, 60, dark});
  return scene;
}

Scene GrayWall() {
  Scene scene;
  const int gray = scene.AddTexture(cv::Mat1b(2, 2, uchar(128)), 1, 1);
  scene.AddRectangle({{6, 30, -30}, -Vector3d::UnitY(), Vector3d::UnitZ(), 60, 60, gray});
  return scene;
}

ImagingOptions Ideal() {
  ImagingOptions imaging;
  imaging.add_noise = false;
  imaging.vignetting = 0;
  return imaging;
}

// Column of the transition from bright to dark in the rows near the middle, from their total
// brightness.
double EdgeColumn(const cv::Mat& image) {
  const cv::Mat rows = image.rowRange(kMiddleRow - 4, kMiddleRow + 5);
  const double bright = rows.at<uchar>(0, 0), dark = rows.at<uchar>(0, rows.cols - 1);
  return (cv::sum(rows)[0] / rows.rows - dark * rows.cols) / (bright - dark) - 0.5;
}

// Column of the edge of HalfBrightWall in the middle row, or nullopt if it is not well in view.
std::optional<double> EdgeInMiddleRow(const CameraModel& camera, const Rigid3d& T_W_C) {
  if ((T_W_C.rotation * Vector3d::UnitZ()).x() < 0.8) return std::nullopt;
  const Rigid3d T_C_W = T_W_C.Inverse();
  double below = -4, above = 8;  // heights on the edge whose rows enclose the middle row
  for (int i = 0; i < 40; ++i) {
    const double z = 0.5 * (below + above);
    const auto pixel = camera.Project(T_C_W * Vector3d(6, 0, z));
    if (!pixel) return std::nullopt;
    (pixel->y() > kMiddleRow ? below : above) = z;
  }
  const auto pixel = camera.Project(T_C_W * Vector3d(6, 0, below));
  if (!pixel || !camera.IsInImage(*pixel, 60)) return std::nullopt;
  return pixel->x();
}

TEST(CameraSimulator, BlurIsCenteredOnTheExposure) {
  Rig rig(Motion::kFast);
  rig.options.extent = {1, 0.6, 0.3};
  const Trajectory trajectory(rig.options);
  const auto model = CameraModel::Create(rig.sensors.cameras[0].parameters);
  const Scene scene = HalfBrightWall();
  ImagingOptions imaging = Ideal();
  imaging.exposure = 0.012;
  const CameraSimulator camera(trajectory, scene, rig.sensors.cameras[0].parameters,
                               rig.sensors.cameras[0].T_B_C, imaging);
  int checked = 0;
  double speed = 0;  // of the edge [px/s]
  for (double t = 1.5; t < 12; t += 0.25) {
    const auto edge = [&](double time) {
      return EdgeInMiddleRow(*model, trajectory.At(time).T_W_B * rig.sensors.cameras[0].T_B_C);
    };
    const auto expected = edge(t), before = edge(t - 0.005), after = edge(t + 0.005);
    if (!expected || !before || !after) continue;
    EXPECT_NEAR(EdgeColumn(camera.Expose(t, 0)), *expected, 0.15) << "at " << t;
    speed = std::max(speed, std::abs(*after - *before) / 0.01);
    ++checked;
  }
  EXPECT_GE(checked, 5);
  EXPECT_GT(speed * imaging.exposure, 2.0) << "there is blur to speak of";
}

TEST(CameraSimulator, ARollingShutterExposesEachRowAtItsOwnTime) {
  Rig rig(Motion::kFast);
  rig.options.extent = {1, 0.6, 0.3};
  const Trajectory trajectory(rig.options);
  const Scene scene = HalfBrightWall();
  ImagingOptions imaging = Ideal();
  const CameraParameters& parameters = rig.sensors.cameras[0].parameters;
  const CameraSimulator global(trajectory, scene, parameters, rig.sensors.cameras[0].T_B_C,
                               imaging);
  imaging.readout = 0.03;
  const CameraSimulator rolling(trajectory, scene, parameters, rig.sensors.cameras[0].T_B_C,
                                imaging);
  constexpr double kTime = 4.0;
  const cv::Mat image = rolling.Expose(kTime, 0), unmoved = global.Expose(kTime, 0);
  double greatest = 0;  // difference of a row's sum of pixels between rolling and global
  for (const int row : {20, 240, 460}) {
    const double delay = imaging.readout * ReadoutShare(row, parameters.height);
    const cv::Mat at_its_time = global.Expose(kTime + delay, 0);
    const double brightness = cv::sum(image.row(row))[0];
    EXPECT_NEAR(brightness, cv::sum(at_its_time.row(row))[0], 30) << row;
    greatest = std::max(greatest, std::abs(brightness - cv::sum(unmoved.row(row))[0]));
  }
  EXPECT_GT(greatest, 180 * 2) << "the edge has moved by pixels";
}

TEST(CameraSimulator, NoiseHasTheRequestedStrengthAndIsNewInEachImage) {
  const Rig rig(Motion::kStill);
  ImagingOptions imaging;
  imaging.vignetting = 0;
  const Trajectory trajectory(rig.options);
  const Scene scene = GrayWall();
  const CameraSimulator camera(trajectory, scene, rig.sensors.cameras[0].parameters,
                               rig.sensors.cameras[0].T_B_C, imaging);
  const cv::Mat first = camera.Expose(1.0, 1), second = camera.Expose(1.0, 2);
  cv::Scalar mean, deviation;
  cv::meanStdDev(first, mean, deviation);
  const double expected = std::sqrt(std::pow(imaging.read_noise, 2) +
                                    std::pow(imaging.shot_noise, 2) * mean[0] + 1.0 / 12);
  EXPECT_NEAR(deviation[0], expected, 0.05);
  cv::Mat difference;
  cv::subtract(first, second, difference, cv::noArray(), CV_32F);
  cv::meanStdDev(difference, mean, deviation);
  EXPECT_NEAR(deviation[0], std::sqrt(2.0) * expected, 0.07);
}

TEST(CameraSimulator, CornersAreDarker) {
  ImagingOptions imaging = Ideal();
  imaging.vignetting = 0.4;
  const Rig rig(Motion::kStill);
  const Trajectory trajectory(rig.options);
  const Scene scene = GrayWall();
  const CameraSimulator camera(trajectory, scene, rig.sensors.cameras[0].parameters,
                               rig.sensors.cameras[0].T_B_C, imaging);
  const cv::Mat image = camera.Expose(1.0, 0);
  const double center = image.at<uchar>(240, 376), corner = image.at<uchar>(0, 0);
  EXPECT_NEAR(corner / center, 0.6, 0.02);
}

TEST(CameraSimulator, SameImageFromAnyNumberOfThreads) {
  const Rig rig(Motion::kFast);
  const Trajectory trajectory(rig.options);
  const Scene scene = HalfBrightWall();
  const CameraSimulator camera(trajectory, scene, rig.sensors.cameras[0].parameters,
                               rig.sensors.cameras[0].T_B_C, ImagingOptions());
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat alone = camera.Expose(1.5, 0);
  cv::setNumThreads(3);
  const cv::Mat together = camera.Expose(1.5, 0);
  cv::setNumThreads(threads);
  EXPECT_EQ(cv::countNonZero(alone != together), 0);
}

}  // namespace
}  // namespace plm_vins::simulator
