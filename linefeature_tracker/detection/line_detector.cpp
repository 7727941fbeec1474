// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/line_detector.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "common/opencv_version.h"
#include "linefeature_tracker/detection/edge_segments.h"

// OpenCV 4.1 to 4.5.3 include neither LSD nor EDLines.
#define HAS_LSD_AND_EDLINES PLM_OPENCV_IS_AT_LEAST(4, 5, 4)
#if HAS_LSD_AND_EDLINES
#include <opencv2/ximgproc/edge_drawing.hpp>
#endif

namespace plm_vins {
namespace {

// Own, since OpenCV's takes more than twice as long: it computes with small cv::Mat.
class FldDetector : public LineDetector {
 public:
  std::vector<LineSegment> Detect(const cv::Mat& image, double min_length_px) override {
    cv::Canny(image, edges_, kCannyLow, kCannyHigh);
    return FindStraightEdges(min_length_px, &edges_);
  }

 private:
  static constexpr double kCannyLow = 50;
  static constexpr double kCannyHigh = 100;

  cv::Mat edges_;
};

#if HAS_LSD_AND_EDLINES
std::vector<LineSegment> LongerThan(double min_length_px, const std::vector<cv::Vec4f>& lines) {
  std::vector<LineSegment> segments;
  for (const cv::Vec4f& line : lines) {
    const LineSegment segment{{line[0], line[1]}, {line[2], line[3]}};
    if (segment.Length() >= min_length_px) segments.push_back(segment);
  }
  return segments;
}

class LsdDetector : public LineDetector {
 public:
  std::vector<LineSegment> Detect(const cv::Mat& image, double min_length_px) override {
    std::vector<cv::Vec4f> lines;
    detector_->detect(image, lines);
    return LongerThan(min_length_px, lines);
  }

 private:
  // The caller has scaled the image already.
  cv::Ptr<cv::LineSegmentDetector> detector_ =
      cv::createLineSegmentDetector(cv::LSD_REFINE_STD, 1.0);
};

class EdLinesDetector : public LineDetector {
 public:
  std::vector<LineSegment> Detect(const cv::Mat& image, double min_length_px) override {
    cv::ximgproc::EdgeDrawing::Params params;
    params.MinLineLength = std::max(static_cast<int>(min_length_px), 1);
    detector_->setParams(params);
    std::vector<cv::Vec4f> lines;
    detector_->detectEdges(image);
    detector_->detectLines(lines);
    return LongerThan(min_length_px, lines);
  }

 private:
  cv::Ptr<cv::ximgproc::EdgeDrawing> detector_ = cv::ximgproc::createEdgeDrawing();
};
#endif

}  // namespace

bool LineDetector::IsAvailable(LineDetectorType type) {
  return type == LineDetectorType::kFld || HAS_LSD_AND_EDLINES;
}

std::unique_ptr<LineDetector> LineDetector::Create(LineDetectorType type) {
  if (type == LineDetectorType::kFld) return std::make_unique<FldDetector>();
#if HAS_LSD_AND_EDLINES
  if (type == LineDetectorType::kLsd) return std::make_unique<LsdDetector>();
  return std::make_unique<EdLinesDetector>();
#else
  throw std::invalid_argument("line_detector: OpenCV " CV_VERSION
                              " has neither lsd nor edlines (4.5.4 and later do); use fld");
#endif
}

}  // namespace plm_vins
