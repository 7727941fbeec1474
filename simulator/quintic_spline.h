// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

namespace plm_vins::simulator {

// Uniform B-spline of degree 5 with exact derivatives. It is four times continuously differentiable
// and inside the convex hull of its control points. The basis follows from the Cox-de Boor
// recurrence.
template <int kDimension>
class QuinticSpline {
 public:
  using Vector = Eigen::Matrix<double, kDimension, 1>;
  struct Value {
    Vector position, velocity, acceleration;
  };

  // n + 5 control points define n segments of `knot_spacing` [s] each.
  QuinticSpline(double knot_spacing, std::vector<Vector> controls)
      : knot_spacing_(knot_spacing), controls_(std::move(controls)) {
    if (controls_.size() < kOrder) throw std::invalid_argument("a quintic spline needs 6 controls");
  }

  double duration() const {
    return knot_spacing_ * static_cast<double>(controls_.size() - kDegree);
  }

  // Returns the value with its first two time derivatives; `t` is clamped to [0, duration()].
  Value At(double t) const {
    const int last_segment = static_cast<int>(controls_.size() - kOrder);
    const double position = std::clamp(t, 0.0, duration()) / knot_spacing_;
    const int segment = std::min(static_cast<int>(position), last_segment);
    const double u = position - segment;
    const Weights cubic = Raise(Raise(Raise(Weights{1}, 1, u), 2, u), 3, u);
    const Weights quartic = Raise(cubic, 4, u);
    return {Combine(segment, Raise(quartic, 5, u)),
            Combine(segment, Differentiate(quartic, 5)) / knot_spacing_,
            Combine(segment, Differentiate(Differentiate(cubic, 4), 5)) /
                (knot_spacing_ * knot_spacing_)};
  }

 private:
  static constexpr int kDegree = 5, kOrder = 6;
  // Basis functions that are non-zero at u; those of degree d are the first d + 1.
  using Weights = std::array<double, kOrder>;

  static double Before(const Weights& weights, int j) { return j > 0 ? weights[j - 1] : 0.0; }

  // Computes the basis of `degree` from that of degree - 1.
  static Weights Raise(const Weights& lower, int degree, double u) {
    Weights raised{};
    for (int j = 0; j <= degree; ++j) {
      raised[j] = ((u + degree - j) * Before(lower, j) + (j + 1 - u) * lower[j]) / degree;
    }
    return raised;
  }

  // Computes derivative k + 1 of the basis of `degree` from derivative k of that of degree - 1.
  static Weights Differentiate(const Weights& lower, int degree) {
    Weights result{};
    for (int j = 0; j <= degree; ++j) result[j] = Before(lower, j) - lower[j];
    return result;
  }

  Vector Combine(int segment, const Weights& weights) const {
    Vector sum = Vector::Zero();
    for (int j = 0; j < kOrder; ++j) sum += weights[j] * controls_[segment + j];
    return sum;
  }

  double knot_spacing_;
  std::vector<Vector> controls_;
};

}  // namespace plm_vins::simulator
