// SPDX-License-Identifier: BSD-3-Clause
// Random faults of IMU and images on a simulated flight: an estimate that diverges must report it
// in time. Many simultaneous faults can still prevent that; their rate is counted and bounded.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <sstream>

#include "common/geometry/rigid3.h"
#include "common/geometry/so3.h"
#include "test/fuzz/fault_maker.h"
#include "test/fuzz/stage_flight.h"
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {
namespace {

using simulator::FeatureDataset;

constexpr double kFlight = 20;                                // [s]
constexpr double kFaultsBegin = 3;                            // when the estimator has started [s]
constexpr double kFewestIncidents = 4, kMostIncidents = 100;  // per flight
constexpr double kMaxError = 1;                               // that may stay unreported [m]
constexpr double kMaxUnsaidShare = 0.002;                     // of the flights; 0 of 1072 were seen
constexpr int kFewUnsaid = 2;                                 // chance
constexpr int64_t kInTime_ns = 1'000'000'000;

struct Counts {
  int64_t flights = 0, incidents = 0, faults = 0, losses = 0, restarts = 0, bridges = 0,
          divergences = 0, unsaid = 0;
};
Counts counts;

const FeatureDataset& Flight() {
  static const FeatureDataset flight = SimulateFastFlight(kFlight);
  return flight;
}

// Compares one run with the ground truth.
class Witness {
 public:
  // True positions and headings by timestamp, which a fault may have changed.
  explicit Witness(const FeatureDataset& flight) {
    for (size_t i = 0; i < flight.points.size(); ++i) {
      truth_[flight.points[i].t_ns] = flight.truth[i].T_W_B();
    }
  }

  void Add(const EstimatorOutput& output) {
    counts.losses += output.status == EstimatorStatus::kLost;
    counts.restarts += output.restarted;
    counts.bridges += output.bridged;
    const bool said = SaysSo(output);
    if (said) T_true_W_.reset();
    if (said || Error(output) <= kMaxError) {
      diverged_ns_.reset();
    } else if (!diverged_ns_) {
      ++counts.divergences;
      diverged_ns_ = output.t_ns;
      unsaid_ = false;
    }
    if (!diverged_ns_ || output.t_ns - *diverged_ns_ < kInTime_ns || unsaid_) return;
    unsaid_ = true;
    ++counts.unsaid;
    Note("a divergence is not announced by " + std::to_string(ToSeconds(output.t_ns)) + " s");
  }

 private:
  static bool SaysSo(const EstimatorOutput& output) {
    return !output.has_pose || output.restarted || output.on_imu_alone || output.contradicted ||
           output.imu_doubted || output.imu_noise_scale > 1;
  }

  // Position error after alignment of the world frame at the last report, since earlier errors have
  // been reported [m]. Errors within the covariance, or with an unknown one,
  // count as zero.
  double Error(const EstimatorOutput& output) {
    const Rigid3d& T_true_B = truth_.at(output.t_ns);
    if (!T_true_W_) {
      const double heading = Yaw(T_true_B.rotation * output.state.rotation().conjugate());
      const Eigen::Quaterniond R(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
      T_true_W_ = Rigid3d(R, T_true_B.translation - R * output.state.position());
    }
    const double error =
        (*T_true_W_ * Eigen::Vector3d(output.state.position()) - T_true_B.translation).norm();
    if (!output.uncertainty) return 0;
    const double deviation = std::sqrt(output.uncertainty->pose.topLeftCorner<3, 3>().trace());
    return error > 3 * deviation ? error : 0;
  }

  std::map<int64_t, Rigid3d> truth_;
  std::optional<Rigid3d> T_true_W_;
  std::optional<int64_t> diverged_ns_;
  bool unsaid_ = false;  // this divergence was not reported in time
};

std::string Report() {
  std::ostringstream text;
  text << counts.flights << " flights, " << counts.incidents << " incidents, " << counts.faults
       << " faults, " << counts.losses << " losses, " << counts.restarts << " restarts, "
       << counts.bridges << " bridged, " << counts.divergences << " divergences, " << counts.unsaid
       << " unsaid";
  return text.str();
}

}  // namespace

Target DivergenceTarget() {
  const auto run = [](const Bytes& bytes) {
    std::seed_seq seed(bytes.begin(), bytes.end());
    std::mt19937_64 random(seed);
    FeatureDataset flight = Flight();
    FaultMaker faults(kFaultsBegin / kFlight, &random, &flight);
    const auto incidents = static_cast<int64_t>(faults.Size(kFewestIncidents, kMostIncidents));
    for (int64_t i = 0; i < incidents; ++i) faults.MakeIncident();
    Witness witness(flight);
    Fly(flight, [&](const EstimatorOutput& output) { witness.Add(output); });
    ++counts.flights;
    counts.incidents += incidents;
    counts.faults += CountFaults(Flight(), flight);
    if (counts.unsaid > kFewUnsaid + kMaxUnsaidShare * static_cast<double>(counts.flights)) {
      std::fprintf(stderr, "divergence: %s\n", Report().c_str());
      std::abort();
    }
  };
  return {"divergence", {Bytes(32, 0)}, run, Report};
}

}  // namespace plm_vins::fuzz
