// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace plm_vins::fuzz {

using Bytes = std::vector<uint8_t>;

inline Bytes ToBytes(const std::string& text) { return {text.begin(), text.end()}; }
inline std::string ToText(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// Damages inputs reproducibly: equal seeds cause equal damage.
class Mutator {
 public:
  explicit Mutator(uint64_t seed) : random_(seed) {}

  size_t Below(size_t limit) { return limit == 0 ? 0 : random_() % limit; }

  // Makes a few changes at random places: flipped bits, unusual numbers, parts removed, duplicated
  // or moved.
  Bytes Mutate(Bytes bytes) {
    for (size_t changes = 1 + Below(8); changes > 0; --changes) Change(&bytes);
    return bytes;
  }

 private:
  void Change(Bytes* bytes) {
    const size_t begin = Below(bytes->size() + 1);
    const size_t length = std::min<size_t>(bytes->size() - begin, 1 + Below(Below(2) ? 8 : 256));
    const auto at = bytes->begin() + static_cast<std::ptrdiff_t>(begin);
    const auto end = at + static_cast<std::ptrdiff_t>(length);
    const Bytes part(at, end);
    switch (Below(6)) {
      case 0:
        for (auto byte = at; byte != end; ++byte) *byte ^= static_cast<uint8_t>(1 << Below(8));
        return;
      case 1:
        for (auto byte = at; byte != end; ++byte) *byte = static_cast<uint8_t>(random_());
        return;
      case 2:
        return Overwrite(Number(), begin, bytes);
      case 3:
        bytes->erase(at, end);
        return;
      case 4:
        bytes->insert(at, part.begin(), part.end());
        return;
      default:
        return Overwrite(part, Below(bytes->size() + 1), bytes);
    }
  }

  static void Overwrite(const Bytes& part, size_t at, Bytes* bytes) {
    const size_t length = std::min(part.size(), bytes->size() - at);
    std::copy_n(part.begin(), length, bytes->begin() + static_cast<std::ptrdiff_t>(at));
  }

  Bytes Number() {
    static const std::vector<std::string> texts = {
        "nan", "-inf", "1e400", "-1", "0", "9223372036854775807", "\"", "&a [*a]", "\n"};
    static const double doubles[] = {0,
                                     -1,
                                     1e300,
                                     5e-324,
                                     std::numeric_limits<double>::infinity(),
                                     std::numeric_limits<double>::quiet_NaN()};
    static const int64_t integers[] = {0, -1, 1, INT32_MAX, INT32_MIN, INT64_MAX, INT64_MIN};
    switch (Below(3)) {
      case 0:
        return ToBytes(texts[Below(texts.size())]);
      case 1:
        return BytesOf(doubles[Below(std::size(doubles))]);
      default:
        return BytesOf(integers[Below(std::size(integers))]);
    }
  }

  template <typename T>
  static Bytes BytesOf(const T& value) {
    Bytes bytes(sizeof(T));
    std::memcpy(bytes.data(), &value, sizeof(T));
    return bytes;
  }

  std::mt19937_64 random_;
};

}  // namespace plm_vins::fuzz
