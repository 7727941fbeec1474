// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <type_traits>

namespace plm_vins {

// Binary serialization. BinaryWriter and BinaryReader have the same interface, so that one function
// template for each struct defines its layout. Little-endian, as all supported machines are.
class BinaryWriter {
 public:
  explicit BinaryWriter(std::ostream* stream) : stream_(stream) {}

  template <typename T>
  void Value(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    stream_->write(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  // Writes each item with `layout(archive, item)`.
  template <typename Items, typename Layout>
  void List(const Items& items, const Layout& layout) {
    Value(static_cast<uint32_t>(items.size()));
    for (const auto& item : items) layout(this, item);
  }
  template <typename T>
  bool Has(const std::optional<T>& value) {
    Value(value.has_value());
    return value.has_value();
  }

 private:
  std::ostream* stream_;
};

// Throws std::runtime_error if the data end early or are damaged.
class BinaryReader {
 public:
  explicit BinaryReader(std::istream* stream) : stream_(stream) {}

  template <typename T>
  void Value(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    std::array<char, sizeof(T)> bytes;
    if (!stream_->read(bytes.data(), bytes.size())) throw std::runtime_error("ends too early");
    std::memcpy(&value, bytes.data(), sizeof(T));
  }
  void Value(bool& value) {
    uint8_t byte = 0;
    Value(byte);
    if (byte > 1) throw std::runtime_error("is damaged");
    value = byte == 1;
  }
  // Appends items as they are read, so that a damaged count cannot allocate much memory.
  template <typename Items, typename Layout>
  void List(Items& items, const Layout& layout) {
    uint32_t size = 0;
    Value(size);
    items.clear();
    items.reserve(std::min<uint32_t>(size, kMostReserved));
    for (; size > 0; --size) {
      items.push_back({});
      layout(this, items.back());
    }
  }
  template <typename T>
  bool Has(std::optional<T>& value) {
    bool has = false;
    Value(has);
    if (has) value.emplace();
    return has;
  }

 private:
  static constexpr uint32_t kMostReserved = 1000;  // items

  std::istream* stream_;
};

// Reads or writes numbers, and all numbers of matrices, in this order.
template <typename Archive, typename... Items>
void Values(Archive* archive, Items&... items) {
  const auto one = [archive](auto& item) {
    if constexpr (std::is_class_v<std::decay_t<decltype(item)>>) {
      for (Eigen::Index i = 0; i < item.size(); ++i) archive->Value(item.data()[i]);
    } else {
      archive->Value(item);
    }
  };
  (one(items), ...);
}

}  // namespace plm_vins
