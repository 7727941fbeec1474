// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

namespace plm_vins {

// Reader of the records of a bag of format 2.0, see https://wiki.ros.org/Bags/Format/2.0. Never
// reads beyond the end of the file or of an unpacked chunk, whatever sizes and offsets the file
// claims; invalid values throw std::runtime_error.

enum class BagOp : uint8_t {
  kMessage = 2,
  kBag = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

using BagFields = std::map<std::string, std::string>;

BagFields ParseBagFields(const std::string& header);

template <typename T>
T BagValue(const std::string& bytes) {
  T value;
  if (bytes.size() != sizeof(T)) throw std::runtime_error("a field of the wrong size");
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

struct BagRecord {
  BagFields fields;
  uint64_t data = 0, end = 0;  // offsets of its data

  const std::string& Text(const std::string& name) const;
  template <typename T>
  T Field(const std::string& name) const {
    return BagValue<T>(Text(name));
  }
};

// A container of records: the file, or an unpacked chunk.
class BagBytes {
 public:
  explicit BagBytes(uint64_t size) : size_(size) {}
  virtual ~BagBytes() = default;

  uint64_t size() const { return size_; }
  std::string Read(uint64_t at, uint64_t size);
  // Reads the record at an offset, which must have this op code and end by `limit`.
  BagRecord ReadRecord(BagOp op, uint64_t at, uint64_t limit);
  BagRecord ReadRecord(BagOp op, uint64_t at) { return ReadRecord(op, at, size_); }

 private:
  virtual void Copy(uint64_t at, std::string* bytes) = 0;

  uint64_t size_;
};

class BagFile : public BagBytes {
 public:
  explicit BagFile(const std::string& file);

 private:
  void Copy(uint64_t at, std::string* bytes) override;

  std::ifstream stream_;
};

// Returns the content of a compressed chunk after verifying its checksums.
std::unique_ptr<BagBytes> UnpackChunk(const BagRecord& chunk, BagFile* file);

}  // namespace plm_vins
