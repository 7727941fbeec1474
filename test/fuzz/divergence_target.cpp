// SPDX-License-Identifier: BSD-3-Clause
// Random faults of IMU and images on a simulated flight: where the estimate goes astray, it says so
// in time. Many faults at once can still fool it; how often is counted, and bounded.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <sstream>

#include "common/rigid3.h"
#include "common/so3.h"
#include "test/fuzz/stage_flight.h"
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {
namespace {

using simulator::FeatureDataset;

constexpr double kFlight = 8;             // [s]
constexpr double kFaultsBegin = 3;        // when the estimator has started [s]
constexpr int kMaxFaults = 20;            // per flight
constexpr double kMaxError = 1;           // that may go unsaid [m]
constexpr double kMaxUnsaidShare = 0.02;  // of the flights; none of 129 was seen
constexpr int kFewUnsaid = 5;             // chance
constexpr int64_t kInTime_ns = 1'000'000'000;

struct Counts {
  int64_t flights = 0, faults = 0, losses = 0, restarts = 0, bridges = 0, divergences = 0,
          unsaid = 0;
};
Counts counts;

const FeatureDataset& Flight() {
  static const FeatureDataset flight = SimulateFastFlight(kFlight);
  return flight;
}

// Draws faults and does them to a flight.
class FaultMaker {
 public:
  FaultMaker(std::mt19937_64* random, FeatureDataset* flight)
      : random_(*random), flight_(*flight) {}

  void Make() { Uniform(0, 1) < 0.5 ? DamageImu() : DamageImages(); }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  size_t Below(size_t limit) { return random_() % limit; }
  // Most faults are small and short, some are neither.
  double Size(double least, double most) {
    return (Below(2) ? 1 : -1) * least * std::pow(most / least, Uniform(0, 1));
  }
  template <typename T, typename Change>
  void Each(size_t longest, std::vector<T>* stream, const Change& change) {
    const size_t begin = static_cast<size_t>(static_cast<double>(stream->size()) *
                                             Uniform(kFaultsBegin / kFlight, 1));
    const size_t count = static_cast<size_t>(std::pow(static_cast<double>(longest), Uniform(0, 1)));
    for (size_t i = begin; i < std::min(begin + count, stream->size()); ++i) change(&(*stream)[i]);
  }

  void DamageImu() {
    const size_t axis = Below(3);
    const double rate = Size(0.1, 100), force = Size(1, 1e4), delay = Size(1e-4, 0.1);
    const ImuSample held = flight_.imu[Below(flight_.imu.size())];
    const size_t kind = Below(5);
    Each(100, &flight_.imu, [&](ImuSample* sample) {
      if (kind == 0) sample->gyro[axis] += rate;
      if (kind == 1) sample->accel[axis] += force;
      if (kind == 2) sample->t_ns += ToNanoseconds(delay);
      if (kind == 3) sample->gyro = held.gyro, sample->accel = held.accel;
      if (kind == 4) sample->gyro[axis] = std::nan("");  // as good as missing
    });
  }

  void DamageImages() {
    const double delay = Size(1e-4, 0.1), shift = Size(1e-3, 0.3);
    const size_t kind = Below(5), share = 1 + Below(4);
    Each(20, &flight_.points, [&](PointFrame* frame) {
      std::vector<PointObservation>& points = frame->points;
      if (kind == 0) points.clear();
      if (kind == 1) frame->t_ns += ToNanoseconds(delay);
      for (size_t i = 0; i < points.size(); i += share) {
        if (kind == 2) points[i].xy.x() += shift;
        if (kind == 3) std::swap(points[i].id, points[Below(points.size())].id);
        if (kind == 4) points[i].id += 1'000'000;
      }
    });
  }

  std::mt19937_64& random_;
  FeatureDataset& flight_;
};

// Follows one run, the truth beside it.
class Witness {
 public:
  // True positions and headings by stamp, which a fault may have moved.
  explicit Witness(const FeatureDataset& flight) {
    for (size_t i = 0; i < flight.points.size(); ++i) {
      truth_[flight.points[i].t_ns] = flight.truth[i].T_W_B();
    }
  }

  void Add(const EstimatorOutput& output) {
    counts.losses += output.status == EstimatorStatus::kLost;
    counts.restarts += output.restarted;
    counts.bridges += output.bridged;
    if (output.restarted) T_true_W_.reset();
    if (SaysSo(output)) said_ns_ = output.t_ns;
    if (output.has_pose && Error(output) > kMaxError) {
      if (!diverged_ns_) ++counts.divergences, diverged_ns_ = output.t_ns;
    } else {
      diverged_ns_.reset();
    }
    if (!diverged_ns_ || output.t_ns - *diverged_ns_ < kInTime_ns) return;
    const bool said = said_ns_ && *said_ns_ >= *diverged_ns_ - kInTime_ns;
    if (said || unsaid_) return;
    unsaid_ = true;
    ++counts.unsaid;
    Note("a divergence is not announced by " + std::to_string(ToSeconds(output.t_ns)) + " s");
  }

 private:
  static bool SaysSo(const EstimatorOutput& output) {
    return !output.has_pose || output.restarted || output.imu_doubted ||
           output.imu_noise_scale > 1 || output.delay;
  }

  // Of the position, the world frame being aligned by its first pose [m]. What the covariance
  // admits is no error.
  double Error(const EstimatorOutput& output) {
    const Rigid3d& T_true_B = truth_.at(output.t_ns);
    if (!T_true_W_) {
      const double heading = Yaw(T_true_B.rotation * output.state.rotation().conjugate());
      const Eigen::Quaterniond R(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
      T_true_W_ = Rigid3d(R, T_true_B.translation - R * output.state.position());
    }
    const double error =
        (*T_true_W_ * Eigen::Vector3d(output.state.position()) - T_true_B.translation).norm();
    const double deviation = std::sqrt(output.pose_covariance.topLeftCorner<3, 3>().trace());
    return error > 3 * deviation ? error : 0;
  }

  std::map<int64_t, Rigid3d> truth_;
  std::optional<Rigid3d> T_true_W_;
  std::optional<int64_t> said_ns_, diverged_ns_;
  bool unsaid_ = false;  // once in this flight
};

std::string Report() {
  std::ostringstream text;
  text << counts.flights << " flights, " << counts.faults << " faults, " << counts.losses
       << " losses, " << counts.restarts << " restarts, " << counts.bridges << " bridged, "
       << counts.divergences << " divergences, in " << counts.unsaid << " flights unsaid";
  return text.str();
}

}  // namespace

Target DivergenceTarget() {
  const auto run = [](const Bytes& bytes) {
    std::seed_seq seed(bytes.begin(), bytes.end());
    std::mt19937_64 random(seed);
    FeatureDataset flight = Flight();
    FaultMaker faults(&random, &flight);
    const size_t count = 1 + random() % kMaxFaults;
    for (size_t i = 0; i < count; ++i) faults.Make();
    Witness witness(flight);
    Fly(flight, [&](const EstimatorOutput& output) { witness.Add(output); });
    ++counts.flights;
    counts.faults += static_cast<int64_t>(count);
    if (counts.unsaid > kFewUnsaid + kMaxUnsaidShare * static_cast<double>(counts.flights)) {
      std::fprintf(stderr, "divergence: %s\n", Report().c_str());
      std::abort();
    }
  };
  return {"divergence", {Bytes(32, 0)}, run, Report};
}

}  // namespace plm_vins::fuzz
