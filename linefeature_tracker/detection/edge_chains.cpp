// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/edge_chains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

namespace plm_vins {
namespace {

constexpr int kRim = 1;
constexpr float kFullTurn = 8;  // [45 deg]
constexpr float kRightAngle = 2;

struct Step {
  int x, y;
  float direction;  // [45 deg], above -4 and up to 4
};

constexpr std::array<Step, 8> kSteps = {{{1, 1, 0},
                                         {0, 1, 1},
                                         {-1, 1, 2},
                                         {-1, 0, 3},
                                         {-1, -1, 4},
                                         {0, -1, -3},
                                         {1, -1, -2},
                                         {1, 0, -1}}};

float Turn(float from, float to) {
  const float turn = std::abs(to - from);
  return std::min(turn, kFullTurn - turn);
}

cv::Mat FindEdges(const cv::Mat& image, double low, double high) {
  cv::Mat edges = cv::Mat::zeros(image.rows + 2 * kRim, image.cols + 2 * kRim, CV_8UC1);
  cv::Canny(image, edges(cv::Rect({kRim, kRim}, image.size())), low, high);
  return edges;
}

}  // namespace

EdgeChains::EdgeChains(const cv::Mat& image, double low, double high)
    : edges_(FindEdges(image, low, high)) {}

bool EdgeChains::Next(EdgeChain* chain) {
  chain->clear();
  if (!FindSeed()) return false;
  Take(seed_, chain);
  while (Continue(chain)) continue;
  return true;
}

// Skips by memchr, since few pixels are edges.
bool EdgeChains::FindSeed() {
  for (; seed_.y < edges_.rows; ++seed_.y, seed_.x = 0) {
    const uint8_t* row = edges_.ptr(seed_.y);
    const void* found = std::memchr(row + seed_.x, 255, edges_.cols - seed_.x);
    if (!found) continue;
    seed_.x = static_cast<int>(static_cast<const uint8_t*>(found) - row);
    return true;
  }
  return false;
}

bool EdgeChains::Continue(EdgeChain* chain) {
  const cv::Point last = chain->back() + cv::Point(kRim, kRim);
  const uint8_t* const rows[] = {edges_.ptr(last.y - 1) + last.x, edges_.ptr(last.y) + last.x,
                                 edges_.ptr(last.y + 1) + last.x};
  const bool begins = chain->size() == 1;  // the first step may take any direction
  const Step* best = nullptr;
  float least_turn = kRightAngle;
  for (const Step& step : kSteps) {
    if (rows[step.y + 1][step.x] == 0) continue;
    const float turn = begins ? 0 : Turn(mean_direction_, step.direction);
    if (turn > least_turn || turn >= kRightAngle) continue;
    best = &step;
    least_turn = turn;
    if (begins) break;
  }
  if (!best) return false;
  const float steps = static_cast<float>(chain->size());
  mean_direction_ = ((steps - 1) * mean_direction_ + best->direction) / steps;
  Take({last.x + best->x, last.y + best->y}, chain);
  return true;
}

void EdgeChains::Take(cv::Point pixel, EdgeChain* chain) {
  edges_.at<uint8_t>(pixel) = 0;
  chain->push_back(pixel - cv::Point(kRim, kRim));
}

}  // namespace plm_vins
