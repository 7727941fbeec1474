// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/description/corner_selection.h"

#include <algorithm>
#include <opencv2/features2d.hpp>
#include <optional>

namespace plm_vins {
namespace {

constexpr int kFastReach_px = 4;     // radius of FAST's circle plus that of non-maximum suppression
constexpr int kClearThreshold = 25;  // [gray levels]

cv::Point TopRight(const cv::Rect& pixels) { return {pixels.x + pixels.width, pixels.y}; }

cv::Rect Grown(const cv::Rect& pixels, int by_px) {
  return {pixels.x - by_px, pixels.y - by_px, pixels.width + 2 * by_px, pixels.height + 2 * by_px};
}

struct Cell {
  cv::Rect pixels;
  bool is_taken = false;                  // contains a known corner
  std::optional<cv::KeyPoint> strongest;  // strongest detected corner

  bool IsOpen() const { return !is_taken && !strongest; }
};

class Grid {
 public:
  Grid(int cell_px, const cv::Size& image)
      : cell_px_(cell_px), columns_((image.width + cell_px - 1) / cell_px) {
    for (int y = 0; y < image.height; y += cell_px) {
      for (int x = 0; x < image.width; x += cell_px) {
        cells_.emplace_back().pixels = {x, y, cell_px, cell_px};
      }
    }
  }

  void Take(const Eigen::Vector2f& uv_px) { CellAt(uv_px.x(), uv_px.y()).is_taken = true; }

  void Offer(const std::vector<cv::KeyPoint>& corners) {
    for (const cv::KeyPoint& corner : corners) {
      Cell& cell = CellAt(corner.pt.x, corner.pt.y);
      const bool is_stronger = !cell.strongest || corner.response > cell.strongest->response;
      if (!cell.is_taken && is_stronger) cell.strongest = corner;
    }
  }

  // Returns the open cells, with horizontally adjacent cells merged.
  std::vector<cv::Rect> OpenPixels() const {
    std::vector<cv::Rect> open;
    for (const Cell& cell : cells_) {
      if (!cell.IsOpen()) continue;
      if (!open.empty() && TopRight(open.back()) == cell.pixels.tl()) {
        open.back() |= cell.pixels;
      } else {
        open.push_back(cell.pixels);
      }
    }
    return open;
  }

  // Returns the strongest corner of each cell, in descending order of response.
  std::vector<cv::KeyPoint> Strongest() const {
    std::vector<cv::KeyPoint> corners;
    for (const Cell& cell : cells_) {
      if (cell.strongest) corners.push_back(*cell.strongest);
    }
    std::stable_sort(
        corners.begin(), corners.end(),
        [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
    return corners;
  }

 private:
  Cell& CellAt(float u, float v) {
    return cells_[static_cast<size_t>(v) / cell_px_ * columns_ + static_cast<size_t>(u) / cell_px_];
  }

  int cell_px_;
  int columns_;
  std::vector<Cell> cells_;  // row-major
};

// Returns the corners inside `pixels` that FAST would detect in the whole image.
std::vector<cv::KeyPoint> FindCorners(const cv::Mat& gray, const cv::Rect& pixels, int threshold) {
  std::vector<cv::KeyPoint> corners;
  if (pixels.empty()) return corners;
  const cv::Rect seen = Grown(pixels, kFastReach_px) & cv::Rect({}, gray.size());
  cv::FAST(gray(seen), corners, threshold, /*nonmaxSuppression=*/true);
  for (cv::KeyPoint& corner : corners) corner.pt += cv::Point2f(seen.tl());
  const auto is_beside = [&](const cv::KeyPoint& corner) { return !pixels.contains(corner.pt); };
  corners.erase(std::remove_if(corners.begin(), corners.end(), is_beside), corners.end());
  return corners;
}

// FAST's response is the highest threshold that still detects the corner. Detecting with a high
// threshold first is faster, and yields the strongest corners of their cells; only the other cells
// are searched with the low threshold.
void OfferCorners(const CornerSelectionOptions& options, const cv::Mat& gray, size_t room,
                  Grid* grid) {
  const cv::Rect inside = Grown(cv::Rect({}, gray.size()), -options.border_px);
  grid->Offer(FindCorners(gray, inside, std::max(kClearThreshold, options.fast_threshold)));
  if (grid->Strongest().size() >= room) return;
  for (const cv::Rect& pixels : grid->OpenPixels()) {
    grid->Offer(FindCorners(gray, pixels & inside, options.fast_threshold));
  }
}

}  // namespace

std::vector<Eigen::Vector2f> SelectCorners(const CornerSelectionOptions& options,
                                           const cv::Mat& gray,
                                           const std::vector<Eigen::Vector2f>& known_px) {
  Grid grid(options.cell_px, gray.size());
  for (const Eigen::Vector2f& uv_px : known_px) grid.Take(uv_px);
  const size_t room = static_cast<size_t>(options.max_corners) -
                      std::min<size_t>(options.max_corners, known_px.size());
  OfferCorners(options, gray, room, &grid);

  std::vector<cv::KeyPoint> strongest = grid.Strongest();
  if (strongest.size() > room) strongest.resize(room);
  std::vector<Eigen::Vector2f> selected;
  selected.reserve(strongest.size());
  for (const cv::KeyPoint& corner : strongest) selected.emplace_back(corner.pt.x, corner.pt.y);
  return selected;
}

}  // namespace plm_vins
