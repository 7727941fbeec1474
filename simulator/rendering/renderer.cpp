// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plm_vins::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kNearPlane = 0.05;  // [m]

// A rotated grid, a little wider than the pixel: a lens is not perfectly sharp.
Vector2d SubpixelOffset(int subpixel) {
  constexpr double kSpread = 1.2;
  const std::array<Vector2d, Renderer::kSubpixels> grid{
      {{-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}}};
  return kSpread * grid[subpixel];
}

}  // namespace

// A rectangle in front of the camera, as linear functions of the ray d = (x, y, 1):
// inverse depth w = n d, place on the rectangle (a, b) = (p d, q d) / w.
struct Renderer::VisibleRectangle {
  const Rectangle* rectangle;
  Vector3f n, p, q;
  Vector2f min, max;  // bounds on the plane z = 1

  float width() const { return static_cast<float>(rectangle->width); }
  float height() const { return static_cast<float>(rectangle->height); }
};

namespace {

// Bounds on z = 1 of a polygon cut off at the near plane; nothing where all of it is behind.
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

Renderer::Renderer(const Scene& scene, std::shared_ptr<const CameraModel> camera)
    : scene_(scene), camera_(std::move(camera)) {
  const cv::Rect image(0, 0, camera_->parameters().width, camera_->parameters().height);
  for (int subpixel = 0; subpixel < kSubpixels; ++subpixel) {
    for (int y = 0; y < image.height; y += kTileSize) {
      for (int x = 0; x < image.width; x += kTileSize) {
        const cv::Rect pixels = cv::Rect(x, y, kTileSize, kTileSize) & image;
        tiles_[subpixel].push_back(MakeTile(pixels, SubpixelOffset(subpixel)));
      }
    }
  }
}

Renderer::RayTile Renderer::MakeTile(const cv::Rect& pixels, const Vector2d& offset_px) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  RayTile tile{pixels, Vector2f::Constant(kInfinity), Vector2f::Constant(-kInfinity), {}, {}};
  for (int row = pixels.y; row < pixels.br().y; ++row) {
    for (int column = pixels.x; column < pixels.br().x; ++column) {
      const auto xy = camera_->Unproject(Vector2d(column, row) + offset_px);
      const Vector2f ray = xy ? Vector2f(xy->cast<float>())
                              : Vector2f::Constant(std::numeric_limits<float>::quiet_NaN());
      tile.x.push_back(ray.x());
      tile.y.push_back(ray.y());
      if (!xy) continue;
      tile.min = tile.min.cwiseMin(ray);
      tile.max = tile.max.cwiseMax(ray);
    }
  }
  return tile;
}

void Renderer::Accumulate(const Rigid3d& T_W_C, int subpixel, cv::Mat1f* sum) const {
  const std::vector<VisibleRectangle> visible = FindVisible(T_W_C);
  const std::vector<RayTile>& tiles = tiles_[subpixel];
  cv::parallel_for_(cv::Range(0, static_cast<int>(tiles.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) RenderTile(tiles[i], visible, sum);
  });
}

std::vector<Renderer::VisibleRectangle> Renderer::FindVisible(const Rigid3d& T_W_C) const {
  const Rigid3d T_C_W = T_W_C.Inverse();
  std::vector<VisibleRectangle> visible;
  for (const Rectangle& r : scene_.rectangles()) {
    const Vector3d corner = T_C_W * r.corner;
    const Vector3d u = T_C_W.rotation * r.u, v = T_C_W.rotation * r.v, normal = u.cross(v);
    const double distance = normal.dot(corner);
    if (distance > -1e-6) continue;  // seen from behind
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

// Conservative: false only where no ray of the tile meets the rectangle.
bool Renderer::Overlaps(const RayTile& tile, const VisibleRectangle& r) {
  if ((r.min.array() > tile.max.array()).any() || (r.max.array() < tile.min.array()).any()) {
    return false;
  }
  // Each edge is a linear function of the ray, negative outside.
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
  const int count = static_cast<int>(tile.x.size());
  std::array<float, kTileSize * kTileSize> nearest{};  // inverse depth
  std::array<int, kTileSize * kTileSize> surface;
  surface.fill(-1);
  for (size_t k = 0; k < visible.size(); ++k) {
    const VisibleRectangle& r = visible[k];
    if ((r.min.array() > tile.max.array()).any() || (r.max.array() < tile.min.array()).any())
      continue;
    const float width = r.width(), height = r.height();
    for (int i = 0; i < count; ++i) {
      const float x = tile.x[i], y = tile.y[i];
      const float w = r.n.x() * x + r.n.y() * y + r.n.z();
      const float a = r.p.x() * x + r.p.y() * y + r.p.z();
      const float b = r.q.x() * x + r.q.y() * y + r.q.z();
      const bool hit =
          (w > nearest[i]) & (a >= 0.0f) & (a <= width * w) & (b >= 0.0f) & (b <= height * w);
      nearest[i] = hit ? w : nearest[i];
      surface[i] = hit ? static_cast<int>(k) : surface[i];
    }
  }
  for (int i = 0; i < count; ++i) {
    if (surface[i] < 0) continue;
    (*sum)(tile.pixels.y + i / tile.pixels.width, tile.pixels.x + i % tile.pixels.width) +=
        Shade(visible[surface[i]], tile.x[i], tile.y[i]);
  }
}

float Renderer::Shade(const VisibleRectangle& surface, float x, float y) const {
  const Vector3f ray(x, y, 1.0f);
  const float depth = 1.0f / surface.n.dot(ray);
  const float a = depth * surface.p.dot(ray), b = depth * surface.q.dot(ray);
  // Area on the rectangle per area of the image; each of the subpixels stands for its share.
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
