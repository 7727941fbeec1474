// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/following/flow_window.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core/hal/intrin.hpp>

namespace plm_vins {
namespace {

constexpr int kLanes = 8;
constexpr int kColumnBits = 8;                            // interpolation weights within a row
constexpr int kRowBits = 15;                              // interpolation weights within a column
constexpr int kSampleBits = kColumnBits + kRowBits - 16;  // fractional bits of samples
// Leaves room for the sums over a row of the largest window within 32 bits.
constexpr int kDifferenceBits = 5;
constexpr int kSlopeBits = 5;             // gradients are scaled by 32, the sum of Scharr's weights
constexpr float kMinSquaredSlope = 0.1F;  // mean squared gradient in the weakest direction [1/px^2]

int InWholeVectors(int columns) { return (columns + kLanes - 1) / kLanes * kLanes; }

// A subpixel position: the pixel above and to the left of it, and the interpolation weights.
struct Subpixel {
  explicit Subpixel(const cv::Point2f& point) : x(cvFloor(point.x)), y(cvFloor(point.y)) {
    const auto part_of = [](float share, int bits) {
      return static_cast<uint16_t>(std::lround(share * static_cast<float>(1 << bits)));
    };
    right = part_of(point.x - static_cast<float>(x), kColumnBits);
    below = part_of(point.y - static_cast<float>(y), kRowBits);
    left = static_cast<uint16_t>((1 << kColumnBits) - right);
    above = static_cast<uint16_t>((1 << kRowBits) - below);
  }

  int x, y;
  uint16_t left, right, above, below;
};

// Samples a block whose first pixel is at `corner`. `columns` is a multiple of the SIMD width.
void Sample(const cv::Mat& image, const Subpixel& corner, int rows, int columns, int16_t* samples) {
  const cv::v_uint16x8 left = cv::v_setall_u16(corner.left);
  const cv::v_uint16x8 right = cv::v_setall_u16(corner.right);
  const cv::v_uint16x8 above = cv::v_setall_u16(corner.above);
  const cv::v_uint16x8 below = cv::v_setall_u16(corner.below);
  const auto step = static_cast<ptrdiff_t>(image.step);
  for (int x = 0; x < columns; x += kLanes) {
    const uint8_t* pixels = image.data + corner.y * step + corner.x + x;
    const auto between_columns = [&] {
      return cv::v_add_wrap(cv::v_mul_wrap(cv::v_load_expand(pixels), left),
                            cv::v_mul_wrap(cv::v_load_expand(pixels + 1), right));
    };
    cv::v_uint16x8 upper = between_columns();
    for (int y = 0; y < rows; ++y) {
      pixels += step;
      const cv::v_uint16x8 lower = between_columns();
      const cv::v_uint16x8 sample =
          cv::v_add_wrap(cv::v_mul_hi(upper, above), cv::v_mul_hi(lower, below));
      cv::v_store(samples + y * columns + x, cv::v_reinterpret_as_s16(sample));
      upper = lower;
    }
  }
}

Eigen::Array4f ToFloats(const cv::v_int32x4& lanes) {
  Eigen::Array4i integers;
  cv::v_store(integers.data(), lanes);
  return integers.cast<float>();
}

}  // namespace

int FlowWindow::Border(int side) { return InWholeVectors(side) + kLanes; }

FlowWindow::FlowWindow(int side)
    : side_(side),
      columns_(InWholeVectors(side)),
      wide_columns_(Border(side)),
      wide_((side + 2) * wide_columns_),
      samples_(side * columns_),
      slopes_x_(side * columns_),
      slopes_y_(side * columns_) {}

cv::Point2f FlowWindow::CornerOf(const cv::Point2f& center) const {
  const float half = 0.5F * static_cast<float>(side_ - 1);
  return {center.x - half, center.y - half};
}

// Returns false for NaN as well.
bool FlowWindow::ShowsImage(const cv::Mat& image, const cv::Point2f& corner) const {
  const auto side = static_cast<float>(side_);
  return corner.x > -side && corner.x < static_cast<float>(image.cols) &&  //
         corner.y > -side && corner.y < static_cast<float>(image.rows);
}

bool FlowWindow::Cut(const cv::Mat& image, const cv::Point2f& center) {
  const cv::Point2f corner = CornerOf(center);
  if (!ShowsImage(image, corner)) return false;
  Sample(image, Subpixel(corner - cv::Point2f(1, 1)), side_ + 2, wide_columns_, wide_.data());
  TakeSlopes();
  return InvertInformation();
}

// Computes gradients by Scharr's operator, as OpenCV's flow does.
void FlowWindow::TakeSlopes() {
  constexpr int kInputBits = 3;  // the greatest sum fits 16 bits
  const cv::v_int16x8 three = cv::v_setall_s16(3), ten = cv::v_setall_s16(10);
  const cv::v_int16x8 half = cv::v_setall_s16(1 << (kInputBits - 1));
  const auto load = [](const int16_t* sample) {
    return cv::v_shr<kSampleBits - kInputBits>(cv::v_load(sample));
  };
  const auto smooth = [&](const cv::v_int16x8& a, const cv::v_int16x8& b, const cv::v_int16x8& c) {
    const cv::v_int16x8 sum =
        cv::v_add_wrap(cv::v_mul_wrap(cv::v_add_wrap(a, c), three), cv::v_mul_wrap(b, ten));
    return cv::v_shr<kInputBits>(cv::v_add_wrap(sum, half));
  };
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < columns_; x += kLanes) {
      const int16_t* upper = &wide_[y * wide_columns_ + x];
      const int16_t* middle = upper + wide_columns_;
      const int16_t* lower = middle + wide_columns_;
      const auto across = [&](const int16_t* row) {
        return cv::v_sub_wrap(load(row + 2), load(row));
      };
      const auto down = [&](int column) {
        return cv::v_sub_wrap(load(lower + column), load(upper + column));
      };
      cv::v_store(&slopes_x_[y * columns_ + x],
                  smooth(across(upper), across(middle), across(lower)));
      cv::v_store(&slopes_y_[y * columns_ + x], smooth(down(0), down(1), down(2)));
    }
    const int begin = y * columns_ + side_, end = (y + 1) * columns_;
    std::fill(slopes_x_.begin() + begin, slopes_x_.begin() + end, 0);
    std::fill(slopes_y_.begin() + begin, slopes_y_.begin() + end, 0);
  }
  Center(&slopes_x_);
  Center(&slopes_y_);
}

// Makes the sum zero: then a step is that of least squares with the offset as a further unknown.
void FlowWindow::Center(std::vector<int16_t>* slopes) const {
  const int pixels = side_ * side_;
  const int sum = std::accumulate(slopes->begin(), slopes->end(), 0);
  const auto mean = static_cast<int16_t>(std::floor(static_cast<double>(sum) / pixels));
  int above_mean = sum - mean * pixels;  // taken from as many pixels
  for (auto row = slopes->begin(); row != slopes->end(); row += columns_) {
    std::for_each_n(row, side_, [mean](int16_t& slope) { slope -= mean; });
    const int count = std::min(above_mean, side_);
    std::for_each_n(row, count, [](int16_t& slope) { --slope; });
    above_mean -= count;
  }
}

bool FlowWindow::InvertInformation() {
  Eigen::Array4f xx = Eigen::Array4f::Zero(), xy = xx, yy = xx;
  for (int row = 0; row < side_ * columns_; row += columns_) {
    cv::v_int32x4 row_xx = cv::v_setzero_s32(), row_xy = row_xx, row_yy = row_xx;
    for (int i = row; i < row + columns_; i += kLanes) {
      const cv::v_int16x8 x = cv::v_load(&slopes_x_[i]), y = cv::v_load(&slopes_y_[i]);
      row_xx = cv::v_dotprod(x, x, row_xx);
      row_xy = cv::v_dotprod(x, y, row_xy);
      row_yy = cv::v_dotprod(y, y, row_yy);
    }
    xx += ToFloats(row_xx);
    xy += ToFloats(row_xy);
    yy += ToFloats(row_yy);
  }
  Eigen::Matrix2f information;
  information << xx.sum(), xy.sum(), xy.sum(), yy.sum();
  const float mean = information.trace() / 2;
  const float spread = std::hypot((information(0, 0) - information(1, 1)) / 2, information(0, 1));
  const auto scale = static_cast<float>(side_ * side_ << (2 * kSlopeBits));
  if (!(mean - spread > kMinSquaredSlope * scale)) return false;
  const float determinant = (mean - spread) * (mean + spread);
  covariance_ << information(1, 1), -information(0, 1), -information(0, 1), information(0, 0);
  covariance_ /= determinant;
  return true;
}

std::optional<cv::Point2f> FlowWindow::Step(const cv::Mat& image, const cv::Point2f& center) {
  const cv::Point2f corner = CornerOf(center);
  if (!ShowsImage(image, corner)) return std::nullopt;
  Sample(image, Subpixel(corner), side_, columns_, samples_.data());
  Eigen::Array4f by_x = Eigen::Array4f::Zero(), by_y = by_x;
  for (int y = 0; y < side_; ++y) {
    const int16_t* before = &wide_[(y + 1) * wide_columns_ + 1];
    cv::v_int32x4 row_x = cv::v_setzero_s32(), row_y = row_x;
    for (int x = 0; x < columns_; x += kLanes) {
      const int i = y * columns_ + x;
      const cv::v_int16x8 difference = cv::v_shr<kSampleBits - kDifferenceBits>(
          cv::v_sub_wrap(cv::v_load(before + x), cv::v_load(&samples_[i])));
      row_x = cv::v_dotprod(difference, cv::v_load(&slopes_x_[i]), row_x);
      row_y = cv::v_dotprod(difference, cv::v_load(&slopes_y_[i]), row_y);
    }
    by_x += ToFloats(row_x);
    by_y += ToFloats(row_y);
  }
  static_assert(kDifferenceBits == kSlopeBits, "their units cancel");
  const Eigen::Vector2f step = covariance_ * Eigen::Vector2f(by_x.sum(), by_y.sum());
  return cv::Point2f(step.x(), step.y());
}

}  // namespace plm_vins
