// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "simulator/random.h"

namespace plm_vins::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kNearPlane = 0.05;  // [m]

using PixelOffsets = std::array<std::array<Vector2d, Renderer::kRays>, Renderer::kSubpixels>;

// Draws the sample positions of a pixel (Latin hypercube): each sixteenth of its columns and of its
// rows has one sample, so that edges in any direction cover a proportionate share of the samples.
// The second half mirrors the first, which centers the samples.
PixelOffsets DrawOffsets(Random* random) {
  constexpr std::array<int, 4> kOrder = {1, 3, 0, 2};
  const double sign = random->Uniform() < 0.5 ? -1.0 : 1.0;
  const auto near = [&](int step) { return (step + random->Uniform()) / 16; };  // within 0 ... 0.25
  PixelOffsets offsets;
  for (int k = 0; k < 4; ++k) {
    const double far_x = 0.25 + near(k), near_y = near(kOrder[k]);
    const double near_x = near(kOrder[k]), far_y = 0.25 + near(k);
    offsets[0][k] = {far_x, sign * near_y};
    offsets[0][k + 4] = {-sign * near_x, far_y};
  }
  for (int k = 0; k < Renderer::kRays; ++k) offsets[1][k] = -offsets[0][k];
  return offsets;
}

}  // namespace

// A rectangle in front of the camera, as linear functions of the ray d = (x, y, 1): inverse depth w
// = n d, position on the rectangle (a, b) = (p d, q d) / w.
struct Renderer::VisibleRectangle {
  const Rectangle* rectangle;
  Vector3f n, p, q;
  Vector2f min, max;  // bounds in the plane z = 1

  float width() const { return static_cast<float>(rectangle->width); }
  float height() const { return static_cast<float>(rectangle->height); }
};

namespace {

// Computes the bounds in the plane z = 1 of a polygon, clipped at the near plane. Returns false if
// it is entirely behind the near plane.
bool ProjectedBounds(const std::array<Vector3d, 4>& corners, Vector2f* min, Vector2f* max) {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const auto include = [&](const Vector3d& p) {
    low = low.cwiseMin(p.hnormalized());
    high = high.cwiseMax(p.hnormalized());
  };
  for (int i = 0; i < 4; ++i) {
    const Vector3d &a = corners[i], &b = corners[(i + 1) % 4];
    if (a.z() >= kNearPlane) include(a);
    if ((a.z() >= kNearPlane) != (b.z() >= kNearPlane)) {
      include(a + (kNearPlane - a.z()) / (b.z() - a.z()) * (b - a));
    }
  }
  *min = low.cast<float>();
  *max = high.cast<float>();
  return low.x() <= high.x();
}

}  // namespace

Renderer::Renderer(const Scene& scene, std::shared_ptr<const CameraModel> camera,
                   const cv::Size& tile)
    : scene_(scene), camera_(std::move(camera)) {
  const cv::Rect image(0, 0, camera_->parameters().width, camera_->parameters().height);
  tiles_per_row_ = (image.width + tile.width - 1) / tile.width;
  for (int y = 0; y < image.height; y += tile.height) {
    for (int x = 0; x < image.width; x += tile.width) {
      AddTile(cv::Rect(cv::Point(x, y), tile) & image);
    }
  }
}

void Renderer::AddTile(const cv::Rect& pixels) {
  Random random(tiles_[0].size());
  std::array<RayTile, kSubpixels> tiles;
  for (RayTile& tile : tiles) tile.pixels = pixels;
  for (int i = 0; i < pixels.area(); ++i) {
    const Vector2d pixel(pixels.x + i % pixels.width, pixels.y + i / pixels.width);
    Eigen::Matrix2d d_xy_d_pixel;
    const auto xy = camera_->Unproject(pixel, &d_xy_d_pixel);
    const PixelOffsets offsets = DrawOffsets(&random);
    for (int subpixel = 0; subpixel < kSubpixels; ++subpixel) {
      for (int k = 0; k < kRays; ++k) {
        const int index = k * pixels.area() + i;
        if (xy) tiles[subpixel].SetRay(index, *xy + d_xy_d_pixel * offsets[subpixel][k]);
      }
    }
  }
  for (int i = 0; i < kSubpixels; ++i) tiles_[i].push_back(tiles[i]);
}

void Renderer::RayTile::SetRay(int index, const Vector2d& xy) {
  const Vector2f ray = xy.cast<float>();
  x[index] = ray.x();
  y[index] = ray.y();
  min = min.cwiseMin(ray);
  max = max.cwiseMax(ray);
}

void Renderer::Accumulate(const Rigid3d& T_W_C, int subpixel, cv::Mat1f* sum) const {
  const std::vector<VisibleRectangle> visible = FindVisible(T_W_C);
  const std::vector<RayTile>& tiles = tiles_[subpixel];
  cv::parallel_for_(cv::Range(0, static_cast<int>(tiles.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) RenderTile(tiles[i], visible, sum);
  });
}

void Renderer::AccumulateByRows(const std::function<Rigid3d(int row)>& T_W_C, int subpixel,
                                cv::Mat1f* sum) const {
  const std::vector<RayTile>& tiles = tiles_[subpixel];
  const int rows = static_cast<int>(tiles.size()) / tiles_per_row_;
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    for (int row = range.start; row < range.end; ++row) {
      const RayTile* first = &tiles[row * tiles_per_row_];
      const std::vector<VisibleRectangle> visible = FindVisible(T_W_C(first->pixels.y));
      for (int i = 0; i < tiles_per_row_; ++i) RenderTile(first[i], visible, sum);
    }
  });
}

std::vector<Renderer::VisibleRectangle> Renderer::FindVisible(const Rigid3d& T_W_C) const {
  const Rigid3d T_C_W = T_W_C.Inverse();
  std::vector<VisibleRectangle> visible;
  for (const Rectangle& r : scene_.rectangles()) {
    const Vector3d corner = T_C_W * r.corner;
    const Vector3d u = T_C_W.rotation * r.u, v = T_C_W.rotation * r.v, normal = u.cross(v);
    const double distance = normal.dot(corner);
    if (distance > -1e-6) continue;  // back-face culling
    const Vector3d right = r.width * u, up = r.height * v;
    VisibleRectangle surface;
    if (!ProjectedBounds({corner, corner + right, corner + right + up, corner + up}, &surface.min,
                         &surface.max)) {
      continue;
    }
    const Vector3d n = normal / distance;
    surface.rectangle = &r;
    surface.n = n.cast<float>();
    surface.p = (u - u.dot(corner) * n).cast<float>();
    surface.q = (v - v.dot(corner) * n).cast<float>();
    visible.push_back(surface);
  }
  return visible;
}

inline float Renderer::InverseDepth(const VisibleRectangle& r, float x, float y) {
  const float w = r.n.x() * x + r.n.y() * y + r.n.z();
  const float a = r.p.x() * x + r.p.y() * y + r.p.z();
  const float b = r.q.x() * x + r.q.y() * y + r.q.z();
  const bool hit = (a >= 0.0f) & (a <= r.width() * w) & (b >= 0.0f) & (b <= r.height() * w);
  return hit ? w : 0.0f;
}

cv::Mat1f Renderer::Depth(const Rigid3d& T_W_C) const {
  const std::vector<VisibleRectangle> visible = FindVisible(T_W_C);
  cv::Mat1f depth(camera_->parameters().height, camera_->parameters().width, 0.0f);
  cv::parallel_for_(cv::Range(0, static_cast<int>(tiles_[0].size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) FindDepth(i, visible, &depth);
  });
  return depth;
}

// The middle of a pixel is that of a sample and its mirror image.
void Renderer::FindDepth(size_t index, const std::vector<VisibleRectangle>& visible,
                         cv::Mat1f* depth) const {
  const RayTile &tile = tiles_[0][index], &mirrored = tiles_[1][index];
  const int pixels = tile.pixels.area();
  std::vector<float> nearest(pixels, 0.0f);  // inverse depth
  for (const VisibleRectangle& rectangle : visible) {
    if (!Overlaps(tile, rectangle) && !Overlaps(mirrored, rectangle)) continue;
    for (int i = 0; i < pixels; ++i) {
      const float x = 0.5f * (tile.x[i] + mirrored.x[i]), y = 0.5f * (tile.y[i] + mirrored.y[i]);
      nearest[i] = std::max(nearest[i], InverseDepth(rectangle, x, y));
    }
  }
  for (int i = 0; i < pixels; ++i) {
    const cv::Point pixel =
        tile.pixels.tl() + cv::Point(i % tile.pixels.width, i / tile.pixels.width);
    if (nearest[i] > 0) (*depth)(pixel) = 1.0f / nearest[i];
  }
}

// Conservative test: returns false only if no ray of the tile intersects the rectangle.
bool Renderer::Overlaps(const RayTile& tile, const VisibleRectangle& r) {
  if ((r.min.array() > tile.max.array()).any() || (r.max.array() < tile.min.array()).any()) {
    return false;
  }
  // Each edge is a linear function of the ray, negative outside the rectangle.
  const auto reaches_inside = [&](const Vector3f& edge) {
    return edge.z() + std::max(edge.x() * tile.min.x(), edge.x() * tile.max.x()) +
               std::max(edge.y() * tile.min.y(), edge.y() * tile.max.y()) >=
           -1e-4f;
  };
  return reaches_inside(r.p) && reaches_inside(r.width() * r.n - r.p) && reaches_inside(r.q) &&
         reaches_inside(r.height() * r.n - r.q);
}

void Renderer::RenderTile(const RayTile& tile, const std::vector<VisibleRectangle>& visible,
                          cv::Mat1f* sum) const {
  const int pixels = tile.pixels.area(), rays = kRays * pixels;
  std::array<float, kRaysPerTile> nearest{};  // inverse depth
  std::array<int, kRaysPerTile> surface;
  surface.fill(-1);
  for (size_t k = 0; k < visible.size(); ++k) {
    const VisibleRectangle& r = visible[k];
    if (!Overlaps(tile, r)) continue;
    for (int i = 0; i < rays; ++i) {
      const float w = InverseDepth(r, tile.x[i], tile.y[i]);
      const bool hit = w > nearest[i];
      nearest[i] = hit ? w : nearest[i];
      surface[i] = hit ? static_cast<int>(k) : surface[i];
    }
  }
  for (int i = 0; i < pixels; ++i) {
    (*sum)(tile.pixels.y + i / tile.pixels.width, tile.pixels.x + i % tile.pixels.width) +=
        ShadePixel(tile, visible, surface, i);
  }
}

// Shades each surface once, at the mean of the rays that hit it.
float Renderer::ShadePixel(const RayTile& tile, const std::vector<VisibleRectangle>& visible,
                           const std::array<int, kRaysPerTile>& surface, int pixel) const {
  const int pixels = tile.pixels.area();
  float brightness = 0;
  std::array<bool, kRays> done{};
  for (int k = 0; k < kRays; ++k) {
    const int hit = surface[k * pixels + pixel];
    if (done[k] || hit < 0) continue;
    Vector2f sum(0, 0);
    int count = 0;
    for (int other = k; other < kRays; ++other) {
      const int index = other * pixels + pixel;
      if (surface[index] != hit) continue;
      done[other] = true;
      sum += Vector2f(tile.x[index], tile.y[index]);
      ++count;
    }
    const Vector2f ray = sum / static_cast<float>(count);
    brightness += static_cast<float>(count) / kRays * Shade(visible[hit], ray.x(), ray.y());
  }
  return brightness;
}

float Renderer::Shade(const VisibleRectangle& surface, float x, float y) const {
  const Vector3f ray(x, y, 1.0f);
  const float depth = 1.0f / surface.n.dot(ray);
  const float a = depth * surface.p.dot(ray), b = depth * surface.q.dot(ray);
  // Area on the rectangle per unit area of the image; each subpixel covers its share of the pixel.
  const Vector2f d_a = depth * (surface.p.head<2>() - a * surface.n.head<2>());
  const Vector2f d_b = depth * (surface.q.head<2>() - b * surface.n.head<2>());
  const float area = std::abs(d_a.x() * d_b.y() - d_a.y() * d_b.x());
  const float pixel = 1.0f / static_cast<float>(camera_->FocalLength());
  const float footprint = pixel * std::sqrt(area / kSubpixels);
  const Rectangle& r = *surface.rectangle;
  return static_cast<float>(r.gain) *
         scene_.textures()[r.texture].Sample(a + static_cast<float>(r.texture_u),
                                             b + static_cast<float>(r.texture_v), footprint);
}

}  // namespace plm_vins::simulator
