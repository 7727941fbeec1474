// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <map>

namespace plm_vins {

// The angle in [-45 deg, 45 deg) that equals `angle` modulo 90 deg [rad].
double WrapQuarterTurn(double angle);

struct HeadingVotesOptions {
  double half_width = M_PI / 60;       // a vote this near supports a heading (3 deg) [rad]
  double memory = 15.0;                // the vote of a line that is gone fades to 1/e in this [s]
  double maturity = 0.5;               // a line followed for so long has a full vote [s]
  double reference_sigma = M_PI / 90;  // a line of this deviation (2 deg) has half a vote [rad]
};

// What the votes say of one heading.
struct HeadingSupport {
  double heading = 0;  // mean of the votes in its favour, in [-45 deg, 45 deg) [rad]
  double sigma = 0;    // standard error of that mean, from the spread of the votes [rad]
  double weight = 0;   // of the votes in its favour
  double total = 0;    // weight of all votes
  int lines = 0;       // lines that voted in its favour
  // Logarithm of the expected number of headings with at least this much support if as many lines
  // had random headings; an upper bound.
  double log_false_alarms = 0;

  double share() const { return total > 0 ? weight / total : 0; }
};

// Horizontal lines vote on the heading of the buildings around, modulo 90 deg. One line has one
// vote, however often it is seen: of weight 1 at most, growing with the time that the line was
// followed and with its accuracy, fading once it left the window. The expected number of false
// alarms [Desolneux2000] decides whether a heading has more support than chance would give it.
class HeadingVotes {
 public:
  explicit HeadingVotes(const HeadingVotesOptions& options = {}) : options_(options) {}

  // Lets time [s] pass: all votes fade; those that would hardly count any more, were their lines
  // followed for however long, are forgotten.
  void Fade(double elapsed);

  // A line's heading as it is now, with its standard deviation [rad], `elapsed` [s] since votes
  // were last cast: a new line was followed for about as long, to be triangulated. It replaces the
  // line's last vote unless that was more certain: a landmark that starts anew knows less than it
  // did.
  void Cast(int64_t id, double heading, double sigma, double elapsed);

  void Remove(int64_t id) { votes_.erase(id); }
  void Clear() { votes_.clear(); }
  size_t size() const { return votes_.size(); }

  // The support of a heading, and of the one that has most.
  HeadingSupport At(double heading) const;
  HeadingSupport Best() const;

 private:
  struct Vote {
    double heading = 0;
    double sigma = 0;
    double followed = 0;   // for this time [s]
    double freshness = 1;  // 1 in the window, then fading
  };

  double MatureWeight(const Vote& vote) const;  // once its line was followed for long enough
  double Weight(const Vote& vote) const;
  double DensestHeading() const;

  HeadingVotesOptions options_;
  std::map<int64_t, Vote> votes_;  // ordered, so that sums are the same in every run
};

}  // namespace plm_vins
