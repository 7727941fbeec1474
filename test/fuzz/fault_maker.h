// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "common/measurements.h"
#include "test/feature_simulator/feature_simulator.h"

namespace plm_vins::fuzz {

// Draws random faults of IMU and images and applies them to a flight. An incident is either one
// lasting fault, or many independent ones within a period.
class FaultMaker {
 public:
  // `begin` is the share of the flight at the start that has no faults.
  FaultMaker(double begin, std::mt19937_64* random, simulator::FeatureDataset* flight)
      : begin_(begin), random_(*random), flight_(*flight) {}

  // Draws a size with log-uniform distribution.
  double Size(double least, double most) { return least * std::pow(most / least, Uniform(0, 1)); }

  void MakeIncident() {
    if (Below(2)) {
      Damage<ImuSample>(kLongest * kSamplesPerImage, &FaultMaker::DrawImuFault, &flight_.imu);
    } else {
      Damage<PointFrame>(kLongest, &FaultMaker::DrawImageFault, &flight_.points);
    }
  }

 private:
  static constexpr double kLongest = 30;  // [images]
  static constexpr double kSamplesPerImage = 10;

  template <typename T>
  using Fault = std::function<void(T*)>;

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  size_t Below(size_t limit) { return random_() % limit; }
  double SignedSize(double least, double most) { return (Below(2) ? 1 : -1) * Size(least, most); }

  template <typename T>
  void Damage(double longest, Fault<T> (FaultMaker::*draw)(), std::vector<T>* stream) {
    const auto size = static_cast<double>(stream->size());
    const auto begin = static_cast<size_t>(size * Uniform(begin_, 1));
    const size_t end = std::min(begin + static_cast<size_t>(Size(1, longest)), stream->size());
    const bool lasts = Below(2);
    const Fault<T> lasting = (this->*draw)();
    const double share = Size(0.01, 1);
    for (size_t i = begin; i < end; ++i) {
      if (lasts) {
        lasting(&(*stream)[i]);
      } else if (Uniform(0, 1) < share) {
        (this->*draw)()(&(*stream)[i]);
      }
    }
  }

  Fault<ImuSample> DrawImuFault() {
    const auto axis = static_cast<Eigen::Index>(Below(3));
    const double rate = SignedSize(0.1, 100), force = SignedSize(1, 1e4);
    const int64_t delay_ns = ToNanoseconds(SignedSize(1e-4, 0.1));
    const ImuSample held = flight_.imu[Below(flight_.imu.size())];
    switch (Below(5)) {
      case 0:
        return [=](ImuSample* sample) { sample->gyro[axis] += rate; };
      case 1:
        return [=](ImuSample* sample) { sample->accel[axis] += force; };
      case 2:
        return [=](ImuSample* sample) { sample->t_ns += delay_ns; };
      case 3:
        return [=](ImuSample* sample) { sample->gyro = held.gyro, sample->accel = held.accel; };
      default:  // equivalent to a missing sample
        return [=](ImuSample* sample) { sample->gyro[axis] = std::nan(""); };
    }
  }

  Fault<PointFrame> DrawImageFault() {
    const int64_t delay_ns = ToNanoseconds(SignedSize(1e-4, 0.1));
    const double share = Size(0.05, 1);
    const auto same = DrawViewFault();
    switch (Below(5)) {
      case 0:
        return [](PointFrame* frame) { frame->points.clear(); };
      case 1:
        return [=](PointFrame* frame) { frame->t_ns += delay_ns; };
      case 2:  // repeats the first image
        return [first = std::optional<PointFrame>()](PointFrame* frame) mutable {
          if (!first) first = *frame;
          frame->points = first->points;
        };
      case 3:
        return [=](PointFrame* frame) {
          for (PointObservation& view : frame->points) {
            if (Uniform(0, 1) < share) same(&view);
          }
        };
      default:
        return [=](PointFrame* frame) {
          for (PointObservation& view : frame->points) {
            if (Uniform(0, 1) < share) DrawViewFault()(&view);
          }
        };
    }
  }

  // Draws a fault of one observation: moved, confused with another point (whose id may then occur
  // twice), given a new id, or not finite.
  Fault<PointObservation> DrawViewFault() {
    const auto axis = static_cast<Eigen::Index>(Below(2));
    const double shift = SignedSize(1e-3, 0.3);
    const auto step = static_cast<int64_t>(1 + Below(5));
    switch (Below(4)) {
      case 0:
        return [=](PointObservation* view) { view->xy[axis] += shift; };
      case 1:
        return [=](PointObservation* view) { view->id += step; };
      case 2:
        return [=](PointObservation* view) { view->id += kNewIds; };
      default:
        return [=](PointObservation* view) { view->xy[axis] = std::nan(""); };
    }
  }

  static constexpr int64_t kNewIds = 1'000'000;  // beyond the ids of any flight

  double begin_;
  std::mt19937_64& random_;
  simulator::FeatureDataset& flight_;
};

// Counts the IMU samples, images and observations that differ; an image without any points counts
// once.
inline int64_t CountFaults(const simulator::FeatureDataset& good,
                           const simulator::FeatureDataset& damaged) {
  int64_t faults = 0;
  for (size_t i = 0; i < good.imu.size(); ++i) {
    const ImuSample &before = good.imu[i], &after = damaged.imu[i];
    faults += before.t_ns != after.t_ns || before.gyro != after.gyro || before.accel != after.accel;
  }
  for (size_t i = 0; i < good.points.size(); ++i) {
    const PointFrame &before = good.points[i], &after = damaged.points[i];
    faults += before.t_ns != after.t_ns || before.points.size() != after.points.size();
    for (size_t k = 0; k < std::min(before.points.size(), after.points.size()); ++k) {
      faults +=
          before.points[k].id != after.points[k].id || before.points[k].xy != after.points[k].xy;
    }
  }
  return faults;
}

}  // namespace plm_vins::fuzz
