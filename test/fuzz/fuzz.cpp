// SPDX-License-Identifier: BSD-3-Clause
// Passes damaged inputs to functions that process external input, for some seconds each. The input
// of an index is reproducible, so that a finding can be repeated: TARGET SECONDS FIRST COUNT.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include "common/stopwatch.h"
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {
namespace {

constexpr double kHang = 10;  // for one input, in CPU time [s]

// The run of a target ends at the first of these limits.
struct Limits {
  double seconds = 5;
  uint64_t inputs = std::numeric_limits<uint64_t>::max();
};

const char* current_target = "";
volatile unsigned long long current_index = 0;

// Prints the current input when a finding aborts the program; sanitizers must be configured to
// abort.
void NameInput(int signal) {
  std::fprintf(stderr, "fuzz: %s, input %llu\n", current_target, current_index);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

Bytes Input(const Target& target, uint64_t index) {
  Mutator mutator(index);
  const Bytes& seed = target.seeds[mutator.Below(target.seeds.size())];
  return index == 0 ? seed : mutator.Mutate(seed);
}

void RunOne(const Target& target, uint64_t index) {
  current_index = index;
  const std::clock_t begin = std::clock();
  try {
    target.run(Input(target, index));
  } catch (const std::exception&) {  // callers catch these
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (seconds > kHang) {
    std::fprintf(stderr, "fuzz: took %.1f s\n", seconds);
    std::abort();
  }
}

void RunTarget(const Target& target, const Limits& limits, uint64_t first) {
  current_target = target.name.c_str();
  const Stopwatch stopwatch;
  uint64_t inputs = 0;
  do {
    RunOne(target, first + inputs++);
  } while (inputs < limits.inputs && stopwatch.Milliseconds() < 1e3 * limits.seconds);
  std::fprintf(stderr, "fuzz: %s, %llu inputs, %s\n", current_target,
               static_cast<unsigned long long>(inputs), target.report().c_str());
}

// Returns false if there is no such target.
bool RunTargets(const std::string& name, const Limits& limits, uint64_t first) {
  bool found = false;
  for (const Target& target : Targets()) {
    if (name != "all" && name != target.name) continue;
    found = true;
    RunTarget(target, limits, first);
  }
  return found;
}

}  // namespace

void Note(const std::string& what) {
  std::fprintf(stderr, "fuzz: %s, input %llu: %s\n", current_target, current_index, what.c_str());
}

}  // namespace plm_vins::fuzz

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "all";
  plm_vins::fuzz::Limits limits;
  if (argc > 2) limits.seconds = std::atof(argv[2]);
  const uint64_t first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 0;
  if (argc > 4) limits.inputs = std::strtoull(argv[4], nullptr, 10);
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE}) {
    std::signal(signal, plm_vins::fuzz::NameInput);
  }
  const bool found = plm_vins::fuzz::RunTargets(name, limits, first);
  if (!found) std::fprintf(stderr, "fuzz: no target %s\n", name.c_str());
  return found ? 0 : 1;
}
