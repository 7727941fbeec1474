// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/streams/drop_counts.h"
#include "offline/ros/bag_records.h"

namespace plm_vins {

// A topic and a message type; a topic may have several types.
using TypedTopic = std::pair<std::string, std::string>;
using TypedTopics = std::set<TypedTopic>;

// One serialized message of a bag.
struct BagMessage {
  TypedTopic topic;
  std::string data;
};

// Reads the messages of a bag in the order of their recording time, using the index at its end.
//
// rosbag follows offsets and sizes in a bag without validating them; this reader drops invalid
// records instead.
class IndexedBag {
 public:
  // Throws std::exception if there is no readable index.
  explicit IndexedBag(const std::string& file);

  TypedTopics topics() const;

  // Selects the topics that Next() returns; must precede the first Next(). Messages of other types
  // on these topics are counted.
  void Select(const TypedTopics& topics);

  std::optional<BagMessage> Next();

  std::optional<int64_t> next_ns() const;  // time of the message that Next() reads first
  std::optional<int64_t> end_ns() const;   // time of the last selected message
  DropCounts problems() const;             // counts of dropped messages

 private:
  struct Chunk {
    uint64_t at = 0;  // offset in the file
    BagRecord record;
    bool damaged = false;

    bool is_packed() const { return record.Text("compression") != "none"; }
  };

  struct Entry {
    int64_t t_ns = 0;
    uint32_t connection = 0, chunk = 0, offset = 0;
  };

  struct UnpackedChunk {
    uint32_t number = 0;
    std::unique_ptr<BagBytes> bytes;
  };

  void ReadIndex(const BagRecord& head);
  // Reads the index records after the chunk at an offset, one for each of its connections. Returns
  // their end.
  uint64_t ReadChunkIndex(uint64_t place, uint32_t lists);
  void AddEntry(const char* bytes, uint32_t connection, uint64_t chunk_size);
  BagMessage ReadMessage(const Entry& entry, const Chunk& chunk);
  // Returns the content of a packed chunk. If it cannot be unpacked, the whole chunk is dropped.
  BagBytes& Unpack(uint32_t number);
  std::string Describe(const std::string& error, const Chunk& chunk) const;

  std::string name_;
  BagFile file_;
  std::map<uint32_t, TypedTopic> connections_;
  std::vector<Chunk> chunks_;
  std::vector<Entry> entries_;  // messages of the selected topics, in temporal order
  size_t next_ = 0;
  // Cache of several chunks, since topics that were written in turn may be in different chunks; in
  // order of last use.
  std::vector<UnpackedChunk> unpacked_;
  DropCount of_another_type_{"messages_of_another_type", 0, ""};
  int64_t damaged_ = 0;
  std::string problem_;
};

}  // namespace plm_vins
