// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/version.hpp>

// Tests in #if whether OpenCV has at least this version.
#define PLM_OPENCV_IS_AT_LEAST(major, minor, revision)                        \
  (CV_VERSION_MAJOR * 10000 + CV_VERSION_MINOR * 100 + CV_VERSION_REVISION >= \
   (major)*10000 + (minor)*100 + (revision))
