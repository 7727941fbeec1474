// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bzlib.h>
#include <roslz4/lz4s.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace plm_vins::testing {

// A bag with a single chunk, split into parts, so that the chunk's content can be damaged before it
// is packed with correct checksums.
class BagWithOneChunk {
 public:
  // `bag` is an uncompressed bag written by rosbag.
  explicit BagWithOneChunk(const std::string& bag) {
    const size_t signature = bag.find('\n') + 1;
    const size_t head_data = signature + 4 + SizeAt(bag, signature);
    const size_t chunk = head_data + 4 + SizeAt(bag, head_data);
    const size_t chunk_data = chunk + 4 + SizeAt(bag, chunk);
    const size_t end = chunk_data + 4 + SizeAt(bag, chunk_data);
    head_ = bag.substr(0, chunk);
    content = bag.substr(chunk_data + 4, end - chunk_data - 4);
    index_ = bag.substr(end);
  }

  // Returns the bag with its content packed; `compression` is "bz2" or "lz4".
  std::string Packed(const std::string& compression) const {
    const std::string packed = compression == "bz2" ? Bz2() : Lz4();
    const std::string header = Field("op", "\x05") + Field("compression", compression) +
                               Field("size", Number<uint32_t>(content.size()));
    const std::string bag = head_ + Sized(header) + Sized(packed);
    const std::string field = "index_pos=";
    return std::string(bag).replace(head_.find(field) + field.size(), sizeof(uint64_t),
                                    Number<uint64_t>(bag.size() + IndexLists())) +
           index_;
  }

  std::string content;

 private:
  static uint32_t SizeAt(const std::string& bytes, size_t at) {
    uint32_t size = 0;
    std::memcpy(&size, bytes.data() + at, sizeof(size));
    return size;
  }

  template <typename T>
  static std::string Number(T value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  static std::string Sized(const std::string& bytes) {
    return Number(static_cast<uint32_t>(bytes.size())) + bytes;
  }
  static std::string Field(const std::string& name, const std::string& value) {
    return Sized(name + "=" + value);
  }

  // Length of the index records, which end at the first connection record.
  size_t IndexLists() const {
    size_t at = 0;
    while (at < index_.size()) {
      const size_t data = at + 4 + SizeAt(index_, at);
      if (index_.substr(at, data - at).find("op=\x04") == std::string::npos) break;
      at = data + 4 + SizeAt(index_, data);
    }
    return at;
  }

  std::string Bz2() const {
    auto size = static_cast<unsigned int>(content.size() + content.size() / 100 + 700);
    std::string packed(size, '\0');
    BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(content.data()),
                             static_cast<unsigned int>(content.size()), 9, 0, 30);
    return packed.substr(0, size);
  }

  std::string Lz4() const {
    auto size = static_cast<unsigned int>(2 * content.size() + 1000);
    std::string packed(size, '\0');
    roslz4_buffToBuffCompress(const_cast<char*>(content.data()),
                              static_cast<unsigned int>(content.size()), packed.data(), &size, 6);
    return packed.substr(0, size);
  }

  std::string head_, index_;
};

}  // namespace plm_vins::testing
