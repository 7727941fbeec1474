// SPDX-License-Identifier: BSD-3-Clause
#include "common/io/command_line.h"

#include <boost/program_options/parsers.hpp>
#include <boost/program_options/positional_options.hpp>
#include <boost/program_options/variables_map.hpp>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "common/format.h"

namespace plm_vins {
namespace {

namespace po = boost::program_options;

// No short options, so that negative numbers are values, and no abbreviations.
constexpr int kStyle = po::command_line_style::allow_long |
                       po::command_line_style::long_allow_adjacent |
                       po::command_line_style::long_allow_next;

void Take(const TakeValue& take, const std::string& name, const std::string& text) {
  const std::string error = take(text);
  if (!error.empty()) throw std::runtime_error("--" + name + ": " + error);
}

}  // namespace

TakeValue TakePath(std::string* path) {
  return [path](const std::string& text) -> std::string {
    *path = text;
    return text.empty() ? "expected a path, but it is empty" : "";
  };
}

TakeValue TakeNumber(double least, double most, double* number) {
  return [=](const std::string& text) -> std::string {
    char* end = nullptr;
    *number = std::strtod(text.c_str(), &end);
    const bool is_number = end != text.c_str() && *end == '\0';
    if (is_number && *number >= least && *number <= most) return "";
    return Format("expected %g to %g instead of ", least, most) + text;
  };
}

CommandLine::CommandLine(const std::string& description) : options_(description) {
  options_.add_options()("help", "print this help and exit");
}

void CommandLine::Add(const std::string& name, const TakeValue& take, const std::string& help) {
  auto* value = po::value<std::string>()->value_name("VALUE");
  value->notifier([=](const std::string& text) { Take(take, name, text); });
  options_.add_options()(name.c_str(), value, help.c_str());
}

void CommandLine::AddList(const std::string& name, const TakeValue& take, const std::string& help) {
  using Texts = std::vector<std::string>;
  auto* value = po::value<Texts>()->value_name("VALUE ...")->multitoken()->composing();
  value->notifier([=](const Texts& texts) {
    for (const std::string& text : texts) Take(take, name, text);
  });
  options_.add_options()(name.c_str(), value, help.c_str());
}

void CommandLine::AddFlag(const std::string& name, bool* is_given, const std::string& help) {
  options_.add_options()(name.c_str(), po::bool_switch(is_given), help.c_str());
}

bool CommandLine::Parse(int argc, const char* const* argv) const {
  const po::positional_options_description none;
  po::variables_map values;
  po::store(
      po::command_line_parser(argc, argv).options(options_).positional(none).style(kStyle).run(),
      values);
  if (values.count("help") > 0) {
    std::ostringstream help;
    help << options_;
    std::fputs(help.str().c_str(), stdout);
    return false;
  }
  po::notify(values);
  return true;
}

}  // namespace plm_vins
