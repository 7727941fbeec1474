// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/csv_reader.h"

#include <cerrno>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr char kBlanks[] = " \t\r";
constexpr char kByteOrderMark[] = "\xef\xbb\xbf";

std::string Trim(const std::string& text) {
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

}  // namespace

CsvReader::CsvReader(const std::string& file, size_t values_per_row)
    : file_(file), values_per_row_(values_per_row), stream_(file) {
  if (stream_) return;
  throw std::runtime_error("cannot read " + file + ": " + std::generic_category().message(errno));
}

std::optional<CsvRow> CsvReader::Next() {
  std::string line;
  while (std::getline(stream_, line)) {
    const bool is_first = ++line_number_ == 1;
    if (is_first && line.rfind(kByteOrderMark, 0) == 0) line.erase(0, sizeof(kByteOrderMark) - 1);
    line = Trim(line);
    if (line.empty() || line.front() == '#') continue;
    if (auto row = Parse(line)) return row;
    Reject();
  }
  return std::nullopt;
}

void CsvReader::Reject() {
  if (bad_lines_++ == 0) first_bad_line_ = Place();
}

std::optional<CsvRow> CsvReader::Parse(const std::string& line) const {
  CsvRow row;
  std::istringstream stream(line);
  std::string field;
  std::getline(stream, field, ',');
  field = Trim(field);
  const char* end = field.data() + field.size();
  const auto parsed = std::from_chars(field.data(), end, row.t_ns);
  if (parsed.ec != std::errc() || parsed.ptr != end || !IsStamp(row.t_ns)) return std::nullopt;
  while (std::getline(stream, field, ',')) row.values.push_back(Trim(field));
  if (row.values.size() < values_per_row_) return std::nullopt;
  return row;
}

}  // namespace plm_vins
