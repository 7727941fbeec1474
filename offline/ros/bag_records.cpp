// SPDX-License-Identifier: BSD-3-Clause
#include "offline/ros/bag_records.h"

#include <bzlib.h>
#include <roslz4/lz4s.h>

#include <algorithm>
#include <boost/smart_ptr/make_unique.hpp>
#include <filesystem>

namespace plm_vins {
namespace {

// Uninitialized memory: a claimed size of 4 GiB uses no physical memory until it is filled.
class UnpackedBytes : public BagBytes {
 public:
  explicit UnpackedBytes(uint32_t size)
      : BagBytes(size), bytes_(boost::make_unique_noinit<char[]>(size)) {}

  char* data() { return bytes_.get(); }

 private:
  void Copy(uint64_t at, std::string* bytes) override {
    std::memcpy(bytes->data(), bytes_.get() + at, bytes->size());
  }

  std::unique_ptr<char[]> bytes_;
};

}  // namespace

BagFields ParseBagFields(const std::string& header) {
  BagFields fields;
  for (size_t at = 0; at < header.size();) {
    const uint64_t size = BagValue<uint32_t>(header.substr(at, sizeof(uint32_t)));
    at += sizeof(uint32_t);
    const size_t equals = header.find('=', at);
    if (at + size > header.size() || equals >= at + size) throw std::runtime_error("a bad header");
    fields[header.substr(at, equals - at)] = header.substr(equals + 1, at + size - equals - 1);
    at += size;
  }
  return fields;
}

const std::string& BagRecord::Text(const std::string& name) const {
  const auto field = fields.find(name);
  if (field == fields.end()) throw std::runtime_error("no field " + name);
  return field->second;
}

std::string BagBytes::Read(uint64_t at, uint64_t size) {
  if (at > size_ || size > size_ - at) throw std::runtime_error("a place beyond its end");
  std::string bytes(size, '\0');
  Copy(at, &bytes);
  return bytes;
}

BagRecord BagBytes::ReadRecord(BagOp op, uint64_t at, uint64_t limit) {
  BagRecord record;
  const uint64_t header_size = BagValue<uint32_t>(Read(at, sizeof(uint32_t)));
  if (header_size > limit - std::min(at, limit))
    throw std::runtime_error("a header beyond its end");
  record.fields = ParseBagFields(Read(at + 4, header_size));
  record.data = at + 4 + header_size + 4;
  record.end = record.data + BagValue<uint32_t>(Read(record.data - 4, sizeof(uint32_t)));
  if (record.Field<BagOp>("op") != op) throw std::runtime_error("a record of another kind");
  if (record.end > limit) throw std::runtime_error("a record beyond its end");
  return record;
}

BagFile::BagFile(const std::string& file)
    : BagBytes(std::filesystem::file_size(file)), stream_(file, std::ios::binary) {
  stream_.exceptions(std::ios::badbit | std::ios::failbit);
}

void BagFile::Copy(uint64_t at, std::string* bytes) {
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(at));
  stream_.read(bytes->data(), static_cast<std::streamsize>(bytes->size()));
}

std::unique_ptr<BagBytes> UnpackChunk(const BagRecord& chunk, BagFile* file) {
  const std::string& compression = chunk.Text("compression");
  std::string packed = file->Read(chunk.data, chunk.end - chunk.data);
  const auto packed_size = static_cast<unsigned int>(packed.size());
  auto unpacked = std::make_unique<UnpackedBytes>(chunk.Field<uint32_t>("size"));
  auto size = static_cast<unsigned int>(unpacked->size());
  bool good = false;
  if (compression == "bz2") {
    good = BZ2_bzBuffToBuffDecompress(unpacked->data(), &size, packed.data(), packed_size,
                                      /*small=*/0, /*verbosity=*/0) == BZ_OK;
  } else if (compression == "lz4") {
    good = roslz4_buffToBuffDecompress(packed.data(), packed_size, unpacked->data(), &size) ==
           ROSLZ4_OK;
  } else {
    throw std::runtime_error("unknown compression " + compression);
  }
  if (!good || size != unpacked->size()) throw std::runtime_error("a chunk that does not unpack");
  return unpacked;
}

}  // namespace plm_vins
