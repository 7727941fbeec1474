// SPDX-License-Identifier: BSD-3-Clause
#include "common/format.h"

#include <cstdarg>
#include <cstdio>

namespace plm_vins {

std::string Format(const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(length > 0 ? static_cast<size_t>(length) : 0, '\0');
  if (length > 0) std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

std::string JoinTexts(const std::vector<std::string>& texts, const std::string& separator) {
  std::string joined;
  for (const std::string& text : texts) {
    joined += (joined.empty() || text.empty() ? "" : separator) + text;
  }
  return joined;
}

}  // namespace plm_vins
