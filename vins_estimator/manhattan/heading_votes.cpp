// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/manhattan/heading_votes.h"

#include <algorithm>
#include <array>

namespace plm_vins {
namespace {

constexpr double kQuarterTurn = M_PI / 2;
constexpr double kHalfWidth = M_PI / 60;  // votes this close support a heading (3 deg) [rad]
constexpr int kBins = 90;                 // bins of 1 deg each, to search for the best heading
constexpr double kForgottenWeight = 0.03;

// Returns the logarithm of a bound on the probability that independent votes of total weight
// `total`, each supporting with probability `chance`, give at least `weight`. This is Hoeffding's
// bound for equal votes; it holds for weights w <= 1 as well, because the logarithm of E[exp(s w
// X)] is convex in w and zero at w = 0.
double LogTail(double weight, double total, double chance) {
  const double share = total > 0 ? std::min(weight / total, 1.0) : 0.0;
  if (share <= chance) return 0;
  const double against = share < 1 ? (1 - share) * std::log((1 - share) / (1 - chance)) : 0;
  return -total * (share * std::log(share / chance) + against);
}

}  // namespace

double WrapQuarterTurn(double angle) {
  return angle - kQuarterTurn * std::floor(angle / kQuarterTurn + 0.5);
}

void HeadingVotes::Fade(double elapsed) {
  const double factor = std::exp(-elapsed / kMemory);
  for (auto it = votes_.begin(); it != votes_.end();) {
    it->second.freshness *= factor;
    it = MatureWeight(it->second) < kForgottenWeight ? votes_.erase(it) : std::next(it);
  }
}

void HeadingVotes::Cast(int64_t id, double heading, double sigma, double elapsed) {
  Vote& vote = votes_[id];
  if (vote.followed == 0 || sigma <= vote.sigma) {
    vote.heading = WrapQuarterTurn(heading);
    vote.sigma = sigma;
  }
  vote.followed += elapsed;
  vote.freshness = 1;
}

double HeadingVotes::MatureWeight(const Vote& vote) const {
  const double deviation = vote.sigma / kReferenceSigma;
  return vote.freshness / (1 + deviation * deviation);
}

double HeadingVotes::Weight(const Vote& vote) const {
  return std::min(1.0, vote.followed / kMaturity) * MatureWeight(vote);
}

HeadingSupport HeadingVotes::At(double heading) const {
  HeadingSupport support;
  double sum = 0, sum_squares = 0;
  for (const auto& [id, vote] : votes_) {
    const double weight = Weight(vote);
    support.total += weight;
    const double deviation = WrapQuarterTurn(vote.heading - heading);
    if (weight <= 0 || std::abs(deviation) > kHalfWidth) continue;
    support.weight += weight;
    sum += weight * deviation;
    sum_squares += weight * deviation * deviation;
    ++support.lines;
  }
  support.heading = WrapQuarterTurn(heading);
  if (support.weight > 0) {
    const double mean = sum / support.weight;
    const double variance = std::max(0.0, sum_squares / support.weight - mean * mean);
    support.heading = WrapQuarterTurn(heading + mean);
    support.sigma = std::sqrt(variance / support.weight);
  }
  const double chance = 2 * kHalfWidth / kQuarterTurn;
  support.log_false_alarms = std::log(kBins) + LogTail(support.weight, support.total, chance);
  return support;
}

HeadingSupport HeadingVotes::Best() const {
  HeadingSupport best = At(DensestHeading());
  constexpr int kRefinements = 3;  // mean-shift steps
  for (int i = 0; i < kRefinements; ++i) {
    const HeadingSupport moved = At(best.heading);
    if (moved.weight < best.weight) break;
    best = moved;
  }
  return best;
}

// Returns the center of the window with the greatest weight, at the resolution of the bins. All
// summed bins lie entirely within kHalfWidth of it.
double HeadingVotes::DensestHeading() const {
  constexpr double kBinWidth = kQuarterTurn / kBins;
  std::array<double, kBins> histogram{};
  for (const auto& [id, vote] : votes_) {
    const int bin = static_cast<int>((vote.heading + kQuarterTurn / 2) / kBinWidth);
    histogram[std::min(bin, kBins - 1)] += Weight(vote);
  }
  const int reach = static_cast<int>(kHalfWidth / kBinWidth - 0.5);
  int densest = 0;
  double greatest = -1;
  for (int center = 0; center < kBins; ++center) {
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) sum += histogram[(center + i + kBins) % kBins];
    if (sum > greatest) {
      greatest = sum;
      densest = center;
    }
  }
  return (densest + 0.5) * kBinWidth - kQuarterTurn / 2;
}

}  // namespace plm_vins
