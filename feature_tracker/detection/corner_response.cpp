// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/corner_response.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace plm_vins {
namespace {

constexpr float kHarrisK = 0.04F;
// Scale of gradients: 1 / (sum of Sobel's weights * block size * number of grey levels).
constexpr float kUnit = 1.0F / (4 * 3 * 255);

struct Gradients {
  cv::Mat x;  // CV_16S
  cv::Mat y;
};

// Products of gradients, summed over the three rows of a block: one element for each column, plus a
// reflected one at both ends.
struct ColumnSums {
  std::vector<int> xx;
  std::vector<int> xy;
  std::vector<int> yy;
};

void AddProducts(const int16_t* a, const int16_t* b, size_t columns, int* sums) {
  for (size_t x = 0; x < columns; ++x) sums[x] += static_cast<int>(a[x]) * b[x];
}

// Sums over the three rows of the blocks centred at row `y`.
void SumColumns(const Gradients& gradients, int y, ColumnSums* sums) {
  const auto columns = static_cast<size_t>(gradients.x.cols);
  for (std::vector<int>* sum : {&sums->xx, &sums->xy, &sums->yy}) sum->assign(columns + 2, 0);
  for (const int beside : {y - 1, y, y + 1}) {
    const int row = cv::borderInterpolate(beside, gradients.x.rows, cv::BORDER_REFLECT_101);
    const auto* gx = gradients.x.ptr<int16_t>(row);
    const auto* gy = gradients.y.ptr<int16_t>(row);
    AddProducts(gx, gx, columns, sums->xx.data() + 1);
    AddProducts(gx, gy, columns, sums->xy.data() + 1);
    AddProducts(gy, gy, columns, sums->yy.data() + 1);
  }
  for (std::vector<int>* sum : {&sums->xx, &sums->xy, &sums->yy}) {
    sum->front() = (*sum)[2];
    sum->back() = (*sum)[columns - 1];
  }
}

// Computes the response of each pixel of a row by `measure` of the covariance (xx, xy; xy, yy).
template <typename Measure>
void MeasureRow(const ColumnSums& sums, const Measure& measure, float* responses) {
  const auto block = [](const std::vector<int>& sum, size_t x) {
    return kUnit * kUnit * static_cast<float>(sum[x] + sum[x + 1] + sum[x + 2]);
  };
  const size_t columns = sums.xx.size() - 2;
  for (size_t x = 0; x < columns; ++x) {
    responses[x] = measure(block(sums.xx, x), block(sums.xy, x), block(sums.yy, x));
  }
}

float LeastEigenvalue(float xx, float xy, float yy) {
  const float half_difference = 0.5F * (xx - yy);
  return 0.5F * (xx + yy) - std::sqrt(half_difference * half_difference + xy * xy);
}

float HarrisMeasure(float xx, float xy, float yy) {
  const float trace = xx + yy;
  return xx * yy - xy * xy - kHarrisK * trace * trace;
}

}  // namespace

cv::Mat CornerResponse(const cv::Mat& image, CornerDetectorType type) {
  Gradients gradients;
  cv::spatialGradient(image, gradients.x, gradients.y);
  ColumnSums sums;
  cv::Mat response(image.size(), CV_32F);
  for (int y = 0; y < image.rows; ++y) {
    SumColumns(gradients, y, &sums);
    auto* const responses = response.ptr<float>(y);
    if (type == CornerDetectorType::kHarris) {
      MeasureRow(sums, HarrisMeasure, responses);
    } else {
      MeasureRow(sums, LeastEigenvalue, responses);
    }
  }
  return response;
}

}  // namespace plm_vins
