// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options/options_description.hpp>
#include <functional>
#include <string>

namespace plm_vins {

// Stores the value of an option; returns an error message, or an empty string if it is valid.
using TakeValue = std::function<std::string(const std::string& text)>;

// Takes a path. Rejects an empty one, which an unset shell variable yields.
TakeValue TakePath(std::string* path);

// Takes a number from `least` to `most`; rejects "nan".
TakeValue TakeNumber(double least, double most, double* number);

// The long options of a program. Errors are std::runtime_error and name the option.
class CommandLine {
 public:
  explicit CommandLine(const std::string& description);

  void Add(const std::string& name, const TakeValue& take, const std::string& help);
  // Adds an option that takes at least one value and may be given several times.
  void AddList(const std::string& name, const TakeValue& take, const std::string& help);
  void AddFlag(const std::string& name, bool* is_given, const std::string& help);

  // Stores all values. Returns false if only --help was requested, which it prints.
  bool Parse(int argc, const char* const* argv) const;

 private:
  boost::program_options::options_description options_;
};

}  // namespace plm_vins
