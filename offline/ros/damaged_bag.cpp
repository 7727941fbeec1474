// SPDX-License-Identifier: BSD-3-Clause
// Bag format 2.0: http://wiki.ros.org/Bags/Format/2.0. A file is a line of text and then records:
// length and bytes of a header ("name=value" fields), length and bytes of the data. A chunk is a
// record whose data are again records, perhaps compressed.
#include <ros/header.h>
#include <rosbag/chunked_file.h>
#include <rosbag/constants.h>
#include <rosbag/exceptions.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/ros/msg_conversion.h"
#include "offline/ros/bag_message_source.h"

namespace plm_vins {
namespace {

constexpr char kMagic[] = "#ROSBAG V2.0";
constexpr uint32_t kMaxHeader = 1 << 20;  // no sane header has a megabyte

// A value of the header as the number that its bytes are (little endian, as the machine's).
template <typename T>
T Number(const ros::M_string& fields, const std::string& name) {
  T value{};
  const auto field = fields.find(name);
  if (field != fields.end() && field->second.size() == sizeof(T)) {
    std::memcpy(&value, field->second.data(), sizeof(T));
  }
  return value;
}

std::string Text(const ros::M_string& fields, const std::string& name) {
  const auto field = fields.find(name);
  return field == fields.end() ? "" : field->second;
}

bool ParseFields(std::vector<uint8_t>* bytes, ros::M_string* fields) {
  ros::Header header;
  std::string error;
  if (!header.parse(bytes->data(), static_cast<uint32_t>(bytes->size()), error)) return false;
  *fields = *header.getValues();
  return true;
}

std::vector<uint8_t> ReadBytes(std::istream* stream, uint64_t size) {
  std::vector<uint8_t> bytes(size);
  stream->read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return bytes;
}

struct Record {
  ros::M_string fields;
  uint32_t data_size = 0;
};

// The record at the stream's position, which moves to its data. Nothing at the end or where the
// bytes are no record.
std::optional<Record> ReadRecord(std::istream* stream) {
  uint32_t header_size = 0;
  Record record;
  stream->read(reinterpret_cast<char*>(&header_size), sizeof(header_size));
  if (!*stream || header_size > kMaxHeader) return std::nullopt;
  std::vector<uint8_t> header = ReadBytes(stream, header_size);
  stream->read(reinterpret_cast<char*>(&record.data_size), sizeof(record.data_size));
  if (!*stream || !ParseFields(&header, &record.fields)) return std::nullopt;
  return record;
}

class DamagedBag : public BagMessageSource {
 public:
  explicit DamagedBag(const std::string& file) : file_(file), stream_(file, std::ios::binary) {
    std::string magic;
    if (!stream_ || !std::getline(stream_, magic) || magic != kMagic) {
      throw std::runtime_error(file + " is not a ROS bag of format 2.0");
    }
    stream_.seekg(0, std::ios::end);
    size_ = static_cast<uint64_t>(stream_.tellg());
    stream_.seekg(sizeof(kMagic));
    decompressor_.openRead(file);
    readable_ = Scan(&stream_, size_, 0);
    std::stable_sort(index_.begin(), index_.end(),
                     [](const Entry& a, const Entry& b) { return a.t_ns < b.t_ns; });
  }

  std::map<std::string, std::string> topics() const override {
    std::map<std::string, std::string> types;
    for (const auto& [id, connection] : connections_) types[connection.topic] = connection.type;
    return types;
  }

  void Select(const std::set<std::string>& topics) override {
    const auto unwanted = [&](const Entry& entry) {
      return topics.count(connections_[entry.connection].topic) == 0;
    };
    index_.erase(std::remove_if(index_.begin(), index_.end(), unwanted), index_.end());
  }

  std::optional<BagMessage> Next() override {
    if (next_ == index_.size()) return std::nullopt;
    const Entry& entry = index_[next_++];
    std::istream& source =
        entry.chunk == 0 ? static_cast<std::istream&>(stream_) : Chunk(entry.chunk);
    source.clear();
    source.seekg(static_cast<std::streamoff>(entry.offset));
    return BagMessage{connections_[entry.connection].topic, ReadBytes(&source, entry.size)};
  }

  std::optional<int64_t> end_ns() const override {
    if (index_.empty()) return std::nullopt;
    return index_.back().t_ns;
  }

  DropCounts problems() const override {
    const std::string share = std::to_string(readable_) + " of " + std::to_string(size_);
    return {{"bag_damaged", 1,
             file_ + ": truncated or without index, the first " + share + " bytes are used"}};
  }

 private:
  struct Connection {
    std::string topic;
    std::string type;
  };
  struct Entry {
    int64_t t_ns;
    uint32_t connection;
    uint64_t
        chunk;  // position of the compressed chunk's record; 0: the message is in the file itself
    uint64_t offset;  // of the message's bytes in the file or in the decompressed chunk
    uint32_t size;
  };

  // Enters the messages of `stream` into the index and returns where intact records end. The
  // records of an uncompressed chunk are read as if they stood in the file, so that an unfinished
  // one can be used.
  uint64_t Scan(std::istream* stream, uint64_t size, uint64_t chunk) {
    uint64_t position = static_cast<uint64_t>(stream->tellg());
    while (const auto record = ReadRecord(stream)) {
      const uint64_t data = static_cast<uint64_t>(stream->tellg());
      const auto op = Number<uint8_t>(record->fields, rosbag::OP_FIELD_NAME);
      const bool descend =
          op == rosbag::OP_CHUNK &&
          Text(record->fields, rosbag::COMPRESSION_FIELD_NAME) == rosbag::COMPRESSION_NONE;
      const uint64_t end = descend ? data : data + record->data_size;
      if (end > size || !Enter(op, *record, stream, {chunk, position, data})) break;
      stream->seekg(static_cast<std::streamoff>(end));
      position = end;
    }
    stream->clear();
    return position;
  }

  struct Place {
    uint64_t chunk;
    uint64_t record;
    uint64_t data;
  };

  // False where the record's data are damaged.
  bool Enter(uint8_t op, const Record& record, std::istream* stream, const Place& place) {
    if (op == rosbag::OP_CONNECTION) return EnterConnection(record, stream);
    if (op == rosbag::OP_MSG_DATA) {
      const auto time = Number<uint64_t>(record.fields, rosbag::TIME_FIELD_NAME);
      const ros::Time stamp(static_cast<uint32_t>(time), static_cast<uint32_t>(time >> 32));
      index_.push_back({ToNanoseconds(stamp),
                        Number<uint32_t>(record.fields, rosbag::CONNECTION_FIELD_NAME), place.chunk,
                        place.data, record.data_size});
    }
    const std::string compression = Text(record.fields, rosbag::COMPRESSION_FIELD_NAME);
    if (op != rosbag::OP_CHUNK || compression == rosbag::COMPRESSION_NONE) return true;
    if (!LoadChunk(place.record)) return false;
    Scan(&chunk_, chunk_size_, place.record);
    return true;
  }

  bool EnterConnection(const Record& record, std::istream* stream) {
    std::vector<uint8_t> data = ReadBytes(stream, record.data_size);
    ros::M_string fields;
    if (!ParseFields(&data, &fields)) return false;
    connections_[Number<uint32_t>(record.fields, rosbag::CONNECTION_FIELD_NAME)] = {
        Text(record.fields, rosbag::TOPIC_FIELD_NAME), Text(fields, "type")};
    return true;
  }

  // Decompresses the chunk whose record is at `position`. False where that fails.
  bool LoadChunk(uint64_t position) {
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(position));
    const auto record = ReadRecord(&stream_);
    const std::string compression = Text(record->fields, rosbag::COMPRESSION_FIELD_NAME);
    const auto size = Number<uint32_t>(record->fields, rosbag::SIZE_FIELD_NAME);
    std::vector<uint8_t> packed = ReadBytes(&stream_, record->data_size);
    std::string bytes(size, '\0');
    try {
      decompressor_.decompress(compression == rosbag::COMPRESSION_BZ2 ? rosbag::compression::BZ2
                                                                      : rosbag::compression::LZ4,
                               reinterpret_cast<uint8_t*>(bytes.data()), size, packed.data(),
                               static_cast<uint32_t>(packed.size()));
    } catch (const rosbag::BagException&) {
      return false;
    }
    chunk_.clear();
    chunk_.str(bytes);
    chunk_size_ = size;
    chunk_position_ = position;
    return true;
  }

  std::istream& Chunk(uint64_t position) {
    if (chunk_position_ != position) LoadChunk(position);
    return chunk_;
  }

  std::string file_;
  std::ifstream stream_;
  uint64_t size_ = 0;
  uint64_t readable_ = 0;
  std::map<uint32_t, Connection> connections_;
  std::vector<Entry> index_;
  size_t next_ = 0;
  rosbag::ChunkedFile decompressor_;
  std::istringstream chunk_;  // the last compressed chunk in use
  uint64_t chunk_size_ = 0;
  uint64_t chunk_position_ = 0;
};

}  // namespace

std::unique_ptr<BagMessageSource> OpenDamagedBag(const std::string& file) {
  return std::make_unique<DamagedBag>(file);
}

}  // namespace plm_vins
