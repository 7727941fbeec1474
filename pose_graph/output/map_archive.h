// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace plm_vins {

// To and from bytes. Both have the same interface, so that one function per struct defines its
// layout. Little-endian, as all machines that we know of.
class MapWriter {
 public:
  template <typename T>
  void Value(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  template <typename T>
  void Resize(const std::vector<T>& values) {
    Value(static_cast<uint32_t>(values.size()));
  }
  template <typename T>
  bool Has(const std::optional<T>& value) {
    Value(static_cast<uint8_t>(value.has_value()));
    return value.has_value();
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Reads bytes that outlive it. Throws std::runtime_error where they end early or are damaged.
class MapReader {
 public:
  explicit MapReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  void Value(T& value) {
    static_assert(std::is_arithmetic_v<T>);
    if (bytes_.size() - next_ < sizeof(value)) throw std::runtime_error("ends early");
    std::memcpy(&value, bytes_.data() + next_, sizeof(value));
    next_ += sizeof(value);
  }
  void Value(bool& value) {
    uint8_t byte = 0;
    Value(byte);
    if (byte > 1) throw std::runtime_error("is damaged");
    value = byte == 1;
  }
  template <typename T>
  void Resize(std::vector<T>& values) {
    uint32_t size = 0;
    Value(size);
    if (size > bytes_.size() - next_) throw std::runtime_error("is damaged");
    values.resize(size);
  }
  template <typename T>
  bool Has(std::optional<T>& value) {
    bool has = false;
    Value(has);
    if (has) value.emplace();
    return has;
  }

 private:
  std::string_view bytes_;
  size_t next_ = 0;
};

}  // namespace plm_vins
