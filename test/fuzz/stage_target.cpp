// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "test/fuzz/stage_flight.h"
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {
namespace {

const simulator::FeatureDataset& Flight() {
  static const simulator::FeatureDataset flight = SimulateFastFlight(4);
  return flight;
}

// A number of any magnitude, most often a moderate one.
double Size(Reader* reader) {
  const int8_t exponent = static_cast<int8_t>(reader->Byte());
  const double sign = exponent % 2 == 0 ? 1 : -1;
  return exponent == -128 ? std::nan("") : sign * std::pow(10.0, exponent / 16.0);
}

// Applies faults as encoded in an input, five bytes each: kind, first sample or image, count, size.
void Damage(const Bytes& bytes, simulator::FeatureDataset* flight) {
  for (Reader reader(bytes); !reader.empty();) {
    const uint8_t kind = reader.Byte();
    const size_t begin = reader.Value<uint16_t>(), count = reader.Byte();
    const double size = Size(&reader);
    const auto imu = [&](const auto& change) {
      const size_t first = begin % flight->imu.size();
      for (size_t i = first; i < std::min(first + count, flight->imu.size()); ++i) {
        change(&flight->imu[i]);
      }
    };
    const auto images = [&](const auto& change) {
      const size_t first = begin % flight->points.size();
      for (size_t i = first; i < std::min(first + count, flight->points.size()); ++i) change(i);
    };
    switch (kind % 8) {
      case 0:
        imu([&](ImuSample* sample) { sample->gyro[kind % 3] += size; });
        break;
      case 1:
        imu([&](ImuSample* sample) { sample->accel[kind % 3] += size; });
        break;
      case 2:
        imu([&](ImuSample* sample) { sample->t_ns += static_cast<int64_t>(1e6 * size); });
        break;
      case 3:
        images([&](size_t i) { flight->points[i].t_ns += static_cast<int64_t>(1e6 * size); });
        break;
      case 4:
        images([&](size_t i) { flight->points[i].points.clear(); });
        break;
      case 5:
        images([&](size_t i) { flight->lines[i].lines.clear(); });
        break;
      case 6:
        images([&](size_t i) {
          for (PointObservation& point : flight->points[i].points) point.xy.x() += 0.01 * size;
        });
        break;
      default:
        images([&](size_t i) {
          for (PointObservation& point : flight->points[i].points) point.id %= 7 + kind;
        });
    }
  }
}

}  // namespace

Target StageTarget() {
  Bytes seed;
  for (uint8_t i = 0; i < 40; ++i) seed.push_back(static_cast<uint8_t>(37 * i));
  return {"stage", {seed}, [](const Bytes& bytes) {
            simulator::FeatureDataset flight = Flight();
            Damage(bytes, &flight);
            Fly(flight, [](const EstimatorOutput&) {});
          }};
}

}  // namespace plm_vins::fuzz
