// SPDX-License-Identifier: BSD-3-Clause
#include "offline/ros/bag_index.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

namespace plm_vins {
namespace {

// See https://wiki.ros.org/Bags/Format/2.0
constexpr char kSignature[] = "#ROSBAG V2.0\n";
constexpr uint64_t kFirstRecord = sizeof(kSignature) - 1;
constexpr uint64_t kIndexEntrySize = 12;  // time, offset into the chunk

enum class Op : uint8_t {
  kMessage = 2,
  kBag = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

template <typename T>
T ValueOf(const std::string& bytes) {
  T value;
  if (bytes.size() != sizeof(T)) throw std::runtime_error("a field of the wrong size");
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

struct Record {
  std::map<std::string, std::string> fields;
  uint64_t data = 0, end = 0;  // positions in the file

  template <typename T>
  T Field(const std::string& name) const {
    const auto field = fields.find(name);
    if (field == fields.end()) throw std::runtime_error("no field " + name);
    return ValueOf<T>(field->second);
  }
};

std::map<std::string, std::string> ParseFields(const std::string& header) {
  std::map<std::string, std::string> fields;
  for (size_t at = 0; at < header.size();) {
    const uint64_t size = ValueOf<uint32_t>(header.substr(at, sizeof(uint32_t)));
    at += sizeof(uint32_t);
    const size_t equals = header.find('=', at);
    if (at + size > header.size() || equals >= at + size) throw std::runtime_error("a bad header");
    fields[header.substr(at, equals - at)] = header.substr(equals + 1, at + size - equals - 1);
    at += size;
  }
  return fields;
}

class BagFile {
 public:
  explicit BagFile(const std::string& file) : stream_(file, std::ios::binary | std::ios::ate) {
    if (stream_) size_ = static_cast<uint64_t>(stream_.tellg());
  }

  bool IsBag() { return size_ > kFirstRecord && Read(0, kFirstRecord) == kSignature; }

  template <typename T>
  T Value(uint64_t at) {
    return ValueOf<T>(Read(at, sizeof(T)));
  }

  // The record at a position, which must be of this kind and end by `limit`.
  Record ReadRecord(Op op, uint64_t at, uint64_t limit) {
    Record record;
    const uint64_t header_size = Value<uint32_t>(at);
    record.fields = ParseFields(Read(at + 4, header_size));
    record.data = at + 4 + header_size + 4;
    record.end = record.data + Value<uint32_t>(record.data - 4);
    if (record.Field<Op>("op") != op) throw std::runtime_error("a record of another kind");
    if (record.end > limit) throw std::runtime_error("a record beyond its end");
    return record;
  }

  Record ReadRecord(Op op, uint64_t at) { return ReadRecord(op, at, size_); }

 private:
  std::string Read(uint64_t at, uint64_t size) {
    if (at > size_ || size > size_ - at) throw std::runtime_error("a position beyond its end");
    std::string bytes(size, '\0');
    stream_.seekg(static_cast<std::streamoff>(at));
    stream_.read(bytes.data(), static_cast<std::streamsize>(size));
    return bytes;
  }

  std::ifstream stream_;
  uint64_t size_ = 0;
};

// That of a message lies in the chunk; where its bytes are at hand, the message does.
void CheckOffset(const Record& chunk, uint32_t offset, BagFile* bag) {
  if (chunk.fields.at("compression") == "none") {
    bag->ReadRecord(Op::kMessage, chunk.data + offset, chunk.end);
  } else if (offset >= chunk.Field<uint32_t>("size")) {
    throw std::runtime_error("a message beyond the end of its chunk");
  }
}

void CheckChunk(const Record& info, const std::set<uint32_t>& connections, BagFile* bag) {
  const Record chunk = bag->ReadRecord(Op::kChunk, info.Field<uint64_t>("chunk_pos"));
  if (chunk.fields.count("compression") == 0) throw std::runtime_error("no field compression");
  uint64_t at = chunk.end;
  for (uint32_t i = info.Field<uint32_t>("count"); i > 0; --i) {
    const Record index = bag->ReadRecord(Op::kIndex, at);
    const uint64_t entries = index.Field<uint32_t>("count");
    if (connections.count(index.Field<uint32_t>("conn")) == 0 ||
        entries * kIndexEntrySize != index.end - index.data) {
      throw std::runtime_error("a bad list of messages");
    }
    for (uint64_t entry = index.data; entry < index.end; entry += kIndexEntrySize) {
      CheckOffset(chunk, bag->Value<uint32_t>(entry + 8), bag);
    }
    at = index.end;
  }
}

}  // namespace

void CheckBagIndex(const std::string& file) {
  BagFile bag(file);
  if (!bag.IsBag()) return;
  const Record head = bag.ReadRecord(Op::kBag, kFirstRecord);
  uint64_t at = head.Field<uint64_t>("index_pos");
  if (at == 0) return;
  std::set<uint32_t> connections;
  for (uint32_t i = head.Field<uint32_t>("conn_count"); i > 0; --i) {
    const Record connection = bag.ReadRecord(Op::kConnection, at);
    connections.insert(connection.Field<uint32_t>("conn"));
    at = connection.end;
  }
  for (uint32_t i = head.Field<uint32_t>("chunk_count"); i > 0; --i) {
    const Record info = bag.ReadRecord(Op::kChunkInfo, at);
    CheckChunk(info, connections, &bag);
    at = info.end;
  }
}

}  // namespace plm_vins
