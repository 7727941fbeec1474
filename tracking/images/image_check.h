// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "common/camera/camera_model.h"
#include "common/measurements.h"

namespace plm_vins {

// Throws std::invalid_argument if the image is not CV_8UC1, not of the calibrated size, or its
// timestamp is not later than `previous_ns`.
void CheckImage(const ImageSample& image, const CameraParameters& camera,
                const std::optional<int64_t>& previous_ns);

// Returns the values of an image, CV_8UC1, and what to check, if a sample of its pixels has nearly
// the same value everywhere; otherwise an empty string.
std::string DescribeIfFlat(const cv::Mat& gray);

// Returns what to check if the image, CV_8UC1, shows the pattern of a raw Bayer image: neighboring
// pixels, of other colors, differ by more than pixels two apart, which are of the same one.
// Otherwise returns an empty string.
std::string DescribeIfBayer(const cv::Mat& gray);

// Returns whether both images, CV_8UC1, have the same size and pixels.
bool AreSame(const cv::Mat& a, const cv::Mat& b);

}  // namespace plm_vins
