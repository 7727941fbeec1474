// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/texture_painter.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace plm_vins::simulator {
namespace {

cv::Mat1b ToGray(const cv::Mat1f& canvas) {
  cv::Mat1b gray;
  canvas.convertTo(gray, CV_8U, 255.0);
  return gray;
}

}  // namespace

int TexturePainter::Pixels(double meters) const {
  return std::max(1, static_cast<int>(std::lround(meters / texel_)));
}

cv::Mat1f TexturePainter::Canvas(double width, double height, double brightness) const {
  return cv::Mat1f(Pixels(height), Pixels(width), static_cast<float>(brightness));
}

// Returns a sum of smooth random fields, each with half the scale and 0.7 times the amplitude of
// the previous one; its values are about +-1. `stretch` elongates the structures vertically.
cv::Mat1f TexturePainter::FractalNoise(const cv::Size& size, double coarsest, double finest,
                                       double stretch) {
  cv::Mat1f sum(size, 0.0f), layer;
  float amplitude = 0.5f;
  for (double cell = coarsest; cell >= finest; cell *= 0.5, amplitude *= 0.7f) {
    const int columns = std::max(2, static_cast<int>(size.width * texel_ / cell) + 1);
    const int rows = std::max(2, static_cast<int>(size.height * texel_ / (cell * stretch)) + 1);
    cv::Mat1f grid(rows, columns);
    for (float& value : grid) value = static_cast<float>(random_.Uniform(-1, 1));
    cv::resize(grid, layer, size, 0, 0, cv::INTER_CUBIC);
    sum += amplitude * layer;
  }
  return sum;
}

cv::Point TexturePainter::RandomPixel(const cv::Mat1f& canvas) {
  const int y = random_.Index(canvas.rows);
  return {random_.Index(canvas.cols), y};
}

void TexturePainter::AddStains(cv::Mat1f* canvas) {
  const double area = canvas->total() * texel_ * texel_;
  for (int i = 0; i < static_cast<int>(10 * area); ++i) {
    const cv::Point center = RandomPixel(*canvas);
    const int height = Pixels(random_.Uniform(0.004, 0.03));
    const cv::Size axes(Pixels(random_.Uniform(0.004, 0.03)), height);
    const double value = (*canvas)(center) + detail_ * random_.Uniform(-0.35, 0.15);
    cv::ellipse(*canvas, center, axes, random_.Uniform(0, 180), 0, 360, value, cv::FILLED);
  }
  for (int i = 0; i < static_cast<int>(2 * area); ++i) {
    const cv::Point start = RandomPixel(*canvas);
    const int down = Pixels(random_.Uniform(0, 0.1));
    const cv::Point offset(Pixels(random_.Uniform(0, 0.3)), down);
    cv::line(*canvas, start, start + offset, (*canvas)(start)-detail_ * random_.Uniform(0.05, 0.25),
             Pixels(0.004));
  }
}

// Simulates the lower illumination in the corners of a room.
void TexturePainter::DarkenEdges(cv::Mat1f* canvas) const {
  constexpr double kReach = 0.5, kDepth = 0.22;  // [m], share of the light
  const auto remaining = [&](int count) {
    cv::Mat1f light(1, count);
    for (int i = 0; i < count; ++i) {
      const double distance = texel_ * std::min(i, count - 1 - i);
      light(0, i) = static_cast<float>(1.0 - kDepth * std::exp(-distance / kReach));
    }
    return light;
  };
  const cv::Mat1f across = remaining(canvas->cols), down = remaining(canvas->rows);
  for (int y = 0; y < canvas->rows; ++y) canvas->row(y) = canvas->row(y).mul(across, down(0, y));
}

void TexturePainter::DrawGrid(cv::Mat1f* canvas, double step_x, double step_y, double joint,
                              bool running_bond, double joint_brightness, double variation) {
  const cv::Mat1f original = canvas->clone();
  canvas->setTo(joint_brightness);
  const cv::Rect all(cv::Point(), canvas->size());
  for (int row = 0; Pixels(row * step_y) < canvas->rows; ++row) {
    const double shift = running_bond && row % 2 == 1 ? -0.5 * step_x : 0.0;
    for (int column = 0; column * step_x + shift < canvas->cols * texel_; ++column) {
      const cv::Point corner(static_cast<int>((column * step_x + shift) / texel_),
                             static_cast<int>(row * step_y / texel_));
      const cv::Rect cell =
          cv::Rect(corner, cv::Size(Pixels(step_x - joint), Pixels(step_y - joint))) & all;
      if (cell.empty()) continue;
      (*canvas)(cell) = original(cell) + variation * random_.Uniform(-1, 1);
    }
  }
}

cv::Mat1b TexturePainter::Plain(double width, double height, double brightness) {
  return ToGray(Canvas(width, height, brightness));
}

cv::Mat1b TexturePainter::Plaster(double width, double height, double brightness) {
  cv::Mat1f canvas = Canvas(width, height, brightness);
  canvas += 0.16 * detail_ * FractalNoise(canvas.size(), 1.0, 0.008, 1.0);
  AddStains(&canvas);
  DarkenEdges(&canvas);
  return ToGray(canvas);
}

cv::Mat1b TexturePainter::Bricks(double width, double height, double brightness) {
  cv::Mat1f canvas = Canvas(width, height, brightness);
  canvas += 0.12 * detail_ * FractalNoise(canvas.size(), 0.1, 0.008, 1.0);
  DrawGrid(&canvas, 0.25, 0.085, 0.012, true, brightness + 0.25 * detail_, 0.12 * detail_);
  DarkenEdges(&canvas);
  return ToGray(canvas);
}

cv::Mat1b TexturePainter::Tiles(double width, double height, double brightness, double tile_size) {
  cv::Mat1f canvas = Canvas(width, height, brightness);
  canvas += 0.12 * detail_ * FractalNoise(canvas.size(), 0.3, 0.01, 1.0);
  AddStains(&canvas);
  // The joints are lines that remain visible without any other detail.
  DrawGrid(&canvas, tile_size, tile_size, 0.012, false, 0.55 * brightness, 0.08 * detail_);
  DarkenEdges(&canvas);
  return ToGray(canvas);
}

cv::Mat1b TexturePainter::Wood(double width, double height, double brightness) {
  cv::Mat1f canvas = Canvas(width, height, brightness);
  canvas += 0.2 * detail_ * FractalNoise(canvas.size(), 0.1, 0.006, 8.0);
  return ToGray(canvas);
}

cv::Mat1b TexturePainter::Panels(double width, double height, double brightness,
                                 double panel_size) {
  cv::Mat1f canvas = Canvas(width, height, brightness);
  canvas += 0.1 * detail_ * FractalNoise(canvas.size(), 0.2, 0.01, 1.0);
  DrawGrid(&canvas, panel_size, panel_size, 0.02, false, 0.6 * brightness, 0.03 * detail_);
  DarkenEdges(&canvas);
  return ToGray(canvas);
}

void TexturePainter::DrawShapes(cv::Mat1f* canvas, int count) {
  const double size = std::min(canvas->cols, canvas->rows);
  for (int i = 0; i < count; ++i) {
    const cv::Point center = RandomPixel(*canvas);
    const double radius = random_.Uniform(0.03, 0.22) * size, turn = random_.Uniform(0, M_PI);
    const int corners = 3 + random_.Index(5);  // seven corners approximate a circle
    std::vector<cv::Point> outline;
    for (int k = 0; k < corners; ++k) {
      const double angle = turn + 2 * M_PI * k / corners;
      outline.emplace_back(center.x + radius * std::cos(angle),
                           center.y + radius * std::sin(angle));
    }
    const double value = random_.Uniform(0.05, 0.95);
    if (corners == 7) {
      cv::circle(*canvas, center, static_cast<int>(radius), value, cv::FILLED);
    } else {
      cv::fillPoly(*canvas, std::vector<std::vector<cv::Point>>{outline}, value);
    }
  }
}

// Draws rows of words that consist of small blocks.
void TexturePainter::DrawText(cv::Mat1f* canvas) {
  const double line_height = random_.Uniform(0.03, 0.08);
  for (double y = line_height; y < canvas->rows * texel_ - line_height; y += 1.6 * line_height) {
    for (double x = line_height; x < canvas->cols * texel_ - 2 * line_height;) {
      const double width = line_height * random_.Uniform(0.2, 0.9);
      const cv::Rect glyph(Pixels(x), Pixels(y), Pixels(width),
                           Pixels(line_height * random_.Uniform(0.5, 1.0)));
      cv::rectangle(*canvas, glyph, random_.Uniform(0.05, 0.3), cv::FILLED);
      x += width + line_height * (random_.Uniform() < 0.2 ? 0.8 : 0.2);
    }
  }
}

cv::Mat1b TexturePainter::Poster(double width, double height) {
  cv::Mat1f canvas = Canvas(width, height, 0.92);
  const int margin = Pixels(0.04);
  cv::Mat1f print = canvas(cv::Rect(margin, margin, std::max(1, canvas.cols - 2 * margin),
                                    std::max(1, canvas.rows - 2 * margin)));
  const cv::Mat1f blank = print.clone();
  const int kind = random_.Index(3);
  if (kind == 0) {
    DrawText(&print);
  } else {
    print.setTo(random_.Uniform(0.25, 0.8));
    DrawShapes(&print, kind == 1 ? 25 : 60);
  }
  const cv::Mat1f faded = blank + detail_ * (print - blank);
  faded.copyTo(print);
  return ToGray(canvas);
}

cv::Mat1b TexturePainter::Books(double width, double height) {
  cv::Mat1f canvas = Canvas(width, height, 0.15);
  for (double x = 0; x < width;) {
    const double thickness = random_.Uniform(0.02, 0.06), top = height * random_.Uniform(0, 0.3);
    const double value = random_.Uniform(0.2, 0.85);
    const cv::Rect spine(Pixels(x), Pixels(top), Pixels(thickness - 0.003), canvas.rows);
    cv::rectangle(canvas, spine, value, cv::FILLED);
    for (int band = 0; band < 3; ++band) {
      const double y = top + (height - top) * random_.Uniform(0.1, 0.9);
      const cv::Rect label(Pixels(x + 0.004), Pixels(y), Pixels(thickness - 0.011), Pixels(0.02));
      cv::rectangle(canvas, label, value > 0.5 ? value - 0.3 : value + 0.3, cv::FILLED);
    }
    x += thickness;
  }
  return ToGray(canvas);
}

cv::Mat1b TexturePainter::View(double width, double height) {
  cv::Mat1f canvas = Canvas(width, height, 1.0);
  cv::Mat1f noise = FractalNoise(canvas.size(), 0.8, 0.03, 1.0);
  const double horizon = 0.55;
  for (int y = 0; y < canvas.rows; ++y) {
    const double share = y / static_cast<double>(canvas.rows);
    const double brightness = share < horizon ? 0.98 - 0.1 * share : 0.55 - 0.2 * (share - horizon);
    const double contrast = (share < horizon ? 0.05 : 0.25) * detail_;
    for (int x = 0; x < canvas.cols; ++x) {
      canvas(y, x) = static_cast<float>(brightness + contrast * noise(y, x));
    }
  }
  return ToGray(canvas);
}

}  // namespace plm_vins::simulator
