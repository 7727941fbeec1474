// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/still_parts.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr double kMaxAge = 1.0;                // maximum age of the reference image [s]
constexpr double kPastInterval = 0.1;          // interval between stored images [s]
constexpr double kCompareInterval = 0.2;       // interval between comparisons [s]
constexpr double kMinShift_px = 8;             // minimum shift of the scene due to the rotation
constexpr size_t kTurns = 8;                   // comparisons to remember
constexpr double kSureRate = 0.5;              // exceeds any gyroscope bias [rad/s]
const double kOtherAxis = std::cos(M_PI / 4);  // cosine of the least angle between other axes
constexpr int kCell_px = 16;

constexpr int kWindow_px = 5;          // correlation window; as large as a projected dot
constexpr double kMinContrast = 5;     // standard deviation in the window [gray levels]
constexpr double kSame = 0.8;          // minimum correlation of parts that stand still
constexpr double kDiffers = 0.5;       // maximum correlation of parts that move
constexpr double kMovingShare = 0.15;  // moving share of textured area if the camera moves
constexpr int kReduction = 4;          // of images in which only large motions are visible

// Up to a tenth of a scene's tracks lie on equal parts by chance.
constexpr int kMinCorners = 10;
constexpr double kStillShare = 0.25;
// Still parts have vanished if less than this share of their area is left; equal parts of the scene
// remain.
constexpr double kRemainder = 0.5;

// Correlation of the windows around each pixel of two images, as the covariance and the product of
// the standard deviations.
struct Correlation {
  cv::Mat textured;             // CV_8UC1: both windows have contrast
  cv::Mat covariance, product;  // CV_32FC1
};

Correlation Correlate(const cv::Mat& gray_a, const cv::Mat& gray_b) {
  const auto mean = [](const cv::Mat& image) -> cv::Mat {
    cv::Mat result;
    cv::boxFilter(image, result, CV_32F, {kWindow_px, kWindow_px});
    return result;
  };
  cv::Mat a, b;
  gray_a.convertTo(a, CV_32F);
  gray_b.convertTo(b, CV_32F);
  const cv::Mat mean_a = mean(a), mean_b = mean(b);
  const cv::Mat variance_a = mean(a.mul(a)) - mean_a.mul(mean_a);
  const cv::Mat variance_b = mean(b.mul(b)) - mean_b.mul(mean_b);
  constexpr double kMinVariance = kMinContrast * kMinContrast;
  Correlation result;
  result.textured = (variance_a > kMinVariance) & (variance_b > kMinVariance);
  result.covariance = mean(a.mul(b)) - mean_a.mul(mean_b);
  cv::sqrt(cv::max(variance_a.mul(variance_b), 0), result.product);
  return result;
}

// Returns whether the scene moves by about kMinShift_px or more in the given part of the image.
bool SceneMoves(const cv::Mat& gray_a, const cv::Mat& gray_b, const cv::Mat& part) {
  const auto reduced = [](const cv::Mat& image, cv::InterpolationFlags method) -> cv::Mat {
    cv::Mat result;
    cv::resize(image, result, image.size() / kReduction, 0, 0, method);
    return result;
  };
  const Correlation correlation =
      Correlate(reduced(gray_a, cv::INTER_AREA), reduced(gray_b, cv::INTER_AREA));
  const cv::Mat textured = correlation.textured & reduced(part, cv::INTER_NEAREST);
  const cv::Mat differs = textured & (correlation.covariance < kDiffers * correlation.product);
  return cv::countNonZero(differs) > kMovingShare * cv::countNonZero(textured);
}

// Returns whether one pixel looks the same in both images, without Correlate()'s cost for all.
bool IsSameAt(const cv::Mat& gray_a, const cv::Mat& gray_b, const cv::Point& center) {
  constexpr int kHalf = kWindow_px / 2;
  constexpr double kPixels = kWindow_px * kWindow_px;
  int sum_a = 0, sum_b = 0, squares_a = 0, squares_b = 0, products = 0;
  for (int y = center.y - kHalf; y <= center.y + kHalf; ++y) {
    const auto *row_a = gray_a.ptr(y), *row_b = gray_b.ptr(y);
    for (int x = center.x - kHalf; x <= center.x + kHalf; ++x) {
      const int a = row_a[x], b = row_b[x];
      sum_a += a;
      sum_b += b;
      squares_a += a * a;
      squares_b += b * b;
      products += a * b;
    }
  }
  const double mean_a = sum_a / kPixels, mean_b = sum_b / kPixels;
  const double variance_a = squares_a / kPixels - mean_a * mean_a;
  const double variance_b = squares_b / kPixels - mean_b * mean_b;
  const double covariance = products / kPixels - mean_a * mean_b;
  return std::min(variance_a, variance_b) > kMinContrast * kMinContrast &&
         covariance > kSame * std::sqrt(variance_a * variance_b);
}

// Returns the share of a mask (CV_8UC1) that is not zero.
double AreaOf(const cv::Mat& mask) {
  return cv::countNonZero(mask) / static_cast<double>(mask.total());
}

}  // namespace

void StillParts::Add(const ImageSample& image, const std::optional<Eigen::Quaterniond>& R_now_then,
                     const std::vector<cv::Point2f>& corners) {
  if (!R_now_then) past_.clear();
  for (Past& past : past_) past.R_now_then = (*R_now_then * past.R_now_then).normalized();
  while (!past_.empty() && ToSeconds(image.t_ns - past_.front().image.t_ns) > kMaxAge) {
    past_.pop_front();
  }
  const bool is_due = !compared_ns_ || ToSeconds(image.t_ns - *compared_ns_) > kCompareInterval;
  const Past* reference = is_due ? FindReference() : nullptr;
  if (reference != nullptr) {
    compared_ns_ = image.t_ns;
    const double share = StandingShare(*reference, image.gray, corners);
    if (share <= kStillShare && moving_.empty()) {
      Remember({Eigen::AngleAxisd(reference->R_now_then).axis(), {}});
    } else if (const cv::Mat turned = TurnedCells(reference->R_now_then);
               CameraMoves(*reference, image.gray, turned)) {
      Compare(*reference, image.gray, turned, corners);
    }
  }
  if (past_.empty() || ToSeconds(image.t_ns - past_.back().image.t_ns) >= kPastInterval) {
    past_.push_back({image, Eigen::Quaterniond::Identity()});
  }
}

const StillParts::Past* StillParts::FindReference() const {
  const double least_turn = kMinShift_px / camera_->FocalLength();
  const auto past = std::find_if(past_.rbegin(), past_.rend(), [&](const Past& candidate) {
    return Eigen::AngleAxisd(candidate.R_now_then).angle() > least_turn;
  });
  return past == past_.rend() ? nullptr : &*past;
}

// Returns whether the rotation moves the cell at a pixel.
bool StillParts::Turns(const Eigen::Quaterniond& R_now_then, const cv::Point& pixel) const {
  const auto center_of = [](int x) {
    const int cell = x / kCell_px;
    return (cell + 0.5) * kCell_px;
  };
  const Eigen::Vector2d center(center_of(pixel.x), center_of(pixel.y));
  const auto ray = camera_->Unproject(center);
  const auto moved = ray ? camera_->Project(R_now_then * ray->homogeneous()) : std::nullopt;
  return moved && (*moved - center).norm() >= kMinShift_px;
}

// Returns the share of the corners in turning cells whose surroundings have not changed; 0 if they
// are few. This is far cheaper than finding all such parts.
double StillParts::StandingShare(const Past& reference, const cv::Mat& gray,
                                 const std::vector<cv::Point2f>& corners) const {
  constexpr int kHalf = kWindow_px / 2;
  const cv::Rect inside(kHalf, kHalf, gray.cols - 2 * kHalf, gray.rows - 2 * kHalf);
  int decided = 0, standing = 0;
  for (const cv::Point corner : corners) {
    if (!inside.contains(corner) || !Turns(reference.R_now_then, corner)) continue;
    ++decided;
    standing += IsSameAt(reference.image.gray, gray, corner) ? 1 : 0;
  }
  return standing >= kMinCorners ? standing / static_cast<double>(decided) : 0;
}

cv::Mat StillParts::TurnedCells(const Eigen::Quaterniond& R_now_then) const {
  const cv::Size size(camera_->parameters().width, camera_->parameters().height);
  cv::Mat cells = cv::Mat::zeros(size, CV_8UC1);
  for (int y = 0; y < size.height; y += kCell_px) {
    for (int x = 0; x < size.width; x += kCell_px) {
      if (!Turns(R_now_then, {x, y})) continue;
      const cv::Rect cell(x, y, kCell_px, kCell_px);
      cells(cell & cv::Rect({}, size)) = 255;
    }
  }
  return cells;
}

bool StillParts::CameraMoves(const Past& reference, const cv::Mat& gray,
                             const cv::Mat& turned) const {
  const double seconds = ToSeconds(*compared_ns_ - reference.image.t_ns);
  return Eigen::AngleAxisd(reference.R_now_then).angle() > kSureRate * seconds ||
         SceneMoves(reference.image.gray, gray, turned);
}

void StillParts::Compare(const Past& reference, const cv::Mat& gray, const cv::Mat& turned,
                         const std::vector<cv::Point2f>& corners) {
  const Correlation correlation = Correlate(reference.image.gray, gray);
  Turn turn{Eigen::AngleAxisd(reference.R_now_then).axis(),
            correlation.textured & turned & (correlation.covariance > kSame * correlation.product)};
  const cv::Mat still = Lasting(turn), moved = turned & ~turn.still;
  Remember(std::move(turn));
  int decided = 0, standing = 0;
  for (const cv::Point2f& corner : corners) {
    decided += turned.at<uint8_t>(corner) != 0 ? 1 : 0;
    standing += still.at<uint8_t>(corner) != 0 ? 1 : 0;
  }
  const bool was_masked = !moving_.empty();
  if (standing >= kMinCorners && standing > kStillShare * decided) {
    largest_share_ = std::max(largest_share_, standing / static_cast<double>(decided));
    still_area_ = std::max(still_area_, AreaOf(still) / AreaOf(turned));
  } else if (!was_masked) {
    return;
  } else if (AreaOf(turned) > 0.5 && AreaOf(still) < kRemainder * still_area_ * AreaOf(turned)) {
    largest_share_ = still_area_ = 0;
  }
  if (!was_masked) {
    still_ = cv::Mat::zeros(gray.size(), CV_8UC1);
    moved_ = still_.clone();
    has_learned_ = true;
  }
  still_.setTo(0, moved & moved_);
  still_ |= still;
  moved_ = moved;
  cv::Mat around;
  cv::dilate(still_, around, cv::Mat::ones(kWindow_px, kWindow_px, CV_8UC1));
  moving_ = ~around;
}

std::string StillParts::Finding() const {
  if (largest_share_ == 0) return "";
  return Format(
      "corners stand still in the image while the camera moves (%.0f %% of them, masked since): "
      "switch an infrared projector off, clean the lens, or mask text and parts of the vehicle "
      "(fisheye_mask)",
      100 * largest_share_);
}

cv::Mat StillParts::Lasting(const Turn& turn) const {
  cv::Mat before = cv::Mat::zeros(turn.still.size(), CV_8UC1);
  const auto other = std::find_if(turns_.begin(), turns_.end(), [&](const Turn& earlier) {
    return earlier.axis.dot(turn.axis) < kOtherAxis;
  });
  if (other != turns_.end() && !other->still.empty()) before |= other->still;
  if (!moving_.empty()) before |= ~moving_;
  return turn.still & before;
}

void StillParts::Remember(Turn turn) {
  turns_.push_front(std::move(turn));
  if (turns_.size() > kTurns) turns_.pop_back();
}

void StillParts::LearnFrom(const StillParts& earlier) {
  Reset();
  still_ = earlier.still_.clone();
  moving_ = earlier.moving_;
  moved_ = cv::Mat::zeros(still_.size(), CV_8UC1);
  largest_share_ = earlier.largest_share_;
  still_area_ = earlier.still_area_;
}

void StillParts::Reset() { *this = StillParts(camera_); }

}  // namespace plm_vins
