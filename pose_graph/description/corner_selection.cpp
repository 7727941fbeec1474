// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/description/corner_selection.h"

#include <algorithm>
#include <opencv2/features2d.hpp>

namespace plm_vins {
namespace {

// The cells of the grid, row by row.
struct Grid {
  Grid(int cell_px, const cv::Size& image)
      : cell_px(cell_px), columns((image.width + cell_px - 1) / cell_px) {}

  size_t CellOf(float u, float v) const {
    return static_cast<size_t>(v) / cell_px * columns + static_cast<size_t>(u) / cell_px;
  }
  size_t CellCount(const cv::Size& image) const {
    return static_cast<size_t>((image.height + cell_px - 1) / cell_px) * columns;
  }

  int cell_px;
  int columns;
};

}  // namespace

std::vector<Eigen::Vector2f> SelectCorners(const CornerSelectionOptions& options,
                                           const cv::Mat& gray,
                                           const std::vector<Eigen::Vector2f>& known_px) {
  const Grid grid(options.cell_px, gray.size());
  std::vector<bool> taken(grid.CellCount(gray.size()), false);
  for (const Eigen::Vector2f& uv : known_px) taken[grid.CellOf(uv.x(), uv.y())] = true;

  std::vector<cv::KeyPoint> found;
  cv::FAST(gray, found, options.fast_threshold, /*nonmaxSuppression=*/true);
  cv::KeyPointsFilter::runByImageBorder(found, gray.size(), options.border_px);
  std::vector<const cv::KeyPoint*> strongest(taken.size(), nullptr);  // by cell
  for (const cv::KeyPoint& corner : found) {
    const size_t cell = grid.CellOf(corner.pt.x, corner.pt.y);
    const cv::KeyPoint*& best = strongest[cell];
    if (!taken[cell] && (best == nullptr || corner.response > best->response)) best = &corner;
  }
  strongest.erase(std::remove(strongest.begin(), strongest.end(), nullptr), strongest.end());
  std::stable_sort(
      strongest.begin(), strongest.end(),
      [](const cv::KeyPoint* a, const cv::KeyPoint* b) { return a->response > b->response; });

  const size_t room = static_cast<size_t>(options.max_corners) -
                      std::min<size_t>(options.max_corners, known_px.size());
  if (strongest.size() > room) strongest.resize(room);
  std::vector<Eigen::Vector2f> selected;
  selected.reserve(strongest.size());
  for (const cv::KeyPoint* corner : strongest) selected.emplace_back(corner->pt.x, corner->pt.y);
  return selected;
}

}  // namespace plm_vins
