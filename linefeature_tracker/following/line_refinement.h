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

// Aligns line segments with image edges, to a few hundredths of a pixel across the line.
//
// Samples along the segment search for the steepest brightness increase across it. A line is fitted
// robustly to these, and its endpoints are set to the extent of the edge. Segments are normalized
// and directed: the brighter side is that of Normal(), so edges of opposite polarity are not
// confused.
class LineRefinement {
 public:
  LineRefinement(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
                 const cv::Mat& mask = {});

  // Finds the edge within `search_px` pixels of the guess. Its endpoints may exceed those of the
  // guess by a few samples. Returns nullopt if too little of the guess shows an edge, or if the
  // result is too short, too close to the image border or masked.
  std::optional<LineSegment> Refine(const cv::Mat& image, const LineSegment& guess,
                                    int search_px) const;

 private:
  struct EdgePoint {
    SegmentSample sample;
    bool found = false;
    double offset_px = 0;  // offset of the edge from the sample, along the normal
  };

  // Fits a few samples, searching the full range.
  std::optional<LineSegment> PlaceRoughly(const cv::Mat& image, const LineSegment& guess,
                                          int search_px) const;
  // Fits all samples of a line known to one or two pixels, and finds its endpoints.
  std::optional<LineSegment> Place(const cv::Mat& image, const LineSegment& rough) const;
  double Step(const LineSegment& segment, double max_samples) const;
  std::vector<EdgePoint> LocateEdges(const cv::Mat& image, const LineSegment& segment, double step,
                                     int extension, int search_px) const;
  bool IsVisible(const Eigen::Vector2d& pixel) const;
  void LocateEdge(const cv::Mat& image, int search_px, EdgePoint* point) const;
  std::optional<LineSegment> SupportedPart(const LineSegment& line, double step,
                                           const std::vector<EdgePoint>& points) const;

  std::shared_ptr<const CameraModel> camera_;
  cv::Mat mask_;  // see ReadMask()
  double min_length_px_;
};

}  // namespace plm_vins
