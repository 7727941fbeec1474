// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <map>

namespace plm_vins {

// Wraps `angle` into [-45 deg, 45 deg), modulo 90 deg [rad].
double WrapQuarterTurn(double angle);

// Support of one heading by the votes.
struct HeadingSupport {
  double heading = 0;  // mean of the supporting votes, in [-45 deg, 45 deg) [rad]
  double sigma = 0;    // standard error of that mean, from the scatter of the votes [rad]
  double weight = 0;   // summed weight of the supporting votes
  double total = 0;    // summed weight of all votes
  int lines = 0;       // number of supporting lines
  // Logarithm of an upper bound on the number of false alarms: the expected number of headings with
  // at least this support if as many lines had random headings.
  double log_false_alarms = 0;

  double share() const { return total > 0 ? weight / total : 0; }
};

// Estimates the heading of the surrounding buildings, modulo 90 deg, from votes of horizontal
// lines. Each line has one vote of weight at most 1, however often it is observed. The weight grows
// with the line's accuracy and with the time for which it was tracked, and decays once the line has
// left the window. The expected number of false alarms [Desolneux2000] tells whether a heading has
// more support than chance would give it.
class HeadingVotes {
 public:
  static constexpr double kMemory = 15;     // time constant of the vote of a lost line [s]
  static constexpr double kMaturity = 0.5;  // a line tracked for this long has its full vote [s]
  static constexpr double kReferenceSigma = M_PI / 90;  // halves the vote (2 deg) [rad]

  // Lets all votes decay by `elapsed` [s] and drops those whose weight would be negligible even at
  // full maturity.
  void Fade(double elapsed);

  // Casts the vote of line `id` with its current heading and standard deviation [rad]; `elapsed`
  // [s] is the time since votes were last cast and counts as tracked time, also for a new line,
  // which was tracked about that long before its triangulation. The vote replaces the line's
  // previous one unless that one was more certain: a landmark that is triangulated again is less
  // certain than before.
  void Cast(int64_t id, double heading, double sigma, double elapsed);

  void Remove(int64_t id) { votes_.erase(id); }
  void Clear() { votes_.clear(); }
  size_t size() const { return votes_.size(); }

  // Returns the support of the given heading (At) or of the best supported one (Best).
  HeadingSupport At(double heading) const;
  HeadingSupport Best() const;

 private:
  struct Vote {
    double heading = 0;
    double sigma = 0;
    double followed = 0;   // tracked for this time [s]
    double freshness = 1;  // 1 while in the window, then decaying
  };

  double MatureWeight(const Vote& vote) const;  // weight at full maturity
  double Weight(const Vote& vote) const;
  double DensestHeading() const;

  std::map<int64_t, Vote> votes_;  // ordered: sums are the same in every run
};

}  // namespace plm_vins
