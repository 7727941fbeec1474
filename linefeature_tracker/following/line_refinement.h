// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "linefeature_tracker/segments/line_segment.h"
#include "linefeature_tracker/segments/segment_sampler.h"

namespace plm_vins {

// Places line segments on the edges of an image, to a few hundredths of a pixel across the line.
//
// Samples along the segment look for the steepest rise of brightness across it; a line is fitted to
// these robustly, and its ends are set to how far the edge goes. Segments are normalised and
// directed: the brighter side is that of Normal(), so an edge of the other sign is not mistaken.
class LineRefinement {
 public:
  LineRefinement(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
                 const cv::Mat& mask = {});

  // The edge at most `search_px` pixels beside the guess. Its ends may lie beyond the guess's by a
  // few samples. Nothing where too little of the guess shows an edge, or that is too short, too
  // close to the image's border or under the mask.
  std::optional<LineSegment> Refine(const cv::Mat& image, const LineSegment& guess,
                                    int search_px) const;

 private:
  struct EdgePoint {
    SegmentSample sample;
    bool found = false;
    double offset_px = 0;  // of the edge from the sample, along its normal
  };

  // On few samples, in the whole range of the search.
  std::optional<LineSegment> PlaceRoughly(const cv::Mat& image, const LineSegment& guess,
                                          int search_px) const;
  // On all samples of a line that is known to a pixel or two, and its ends.
  std::optional<LineSegment> Place(const cv::Mat& image, const LineSegment& rough) const;
  double Step(const LineSegment& segment, double max_samples) const;
  std::vector<EdgePoint> LocateEdges(const cv::Mat& image, const LineSegment& segment, double step,
                                     int extension, int search_px) const;
  bool IsVisible(const Eigen::Vector2d& pixel) const;
  void LocateEdge(const cv::Mat& image, int search_px, EdgePoint* point) const;
  std::optional<LineSegment> SupportedPart(const LineSegment& line, double step,
                                           const std::vector<EdgePoint>& points) const;

  LineTrackerConfig config_;
  std::shared_ptr<const CameraModel> camera_;
  cv::Mat mask_;  // as of ReadMask()
  double min_length_px_;
};

}  // namespace plm_vins
