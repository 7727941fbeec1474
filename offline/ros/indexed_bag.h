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

// A topic and the type of messages on it, of which it may have several.
using TypedTopic = std::pair<std::string, std::string>;
using TypedTopics = std::set<TypedTopic>;

// One serialised message of a bag.
struct BagMessage {
  TypedTopic topic;
  std::string data;
};

// The messages of a bag in the order of their time of recording, by the index at its end.
//
// rosbag follows the index and the sizes in messages without a look at where they lead; so bags are
// read here, and what leads nowhere is left out.
class IndexedBag {
 public:
  // Throws std::exception where there is no index that can be read.
  explicit IndexedBag(const std::string& file);

  TypedTopics topics() const;

  // Chooses what Next() gives; before the first Next(). What else is on these topics is counted.
  void Select(const TypedTopics& topics);

  std::optional<BagMessage> Next();

  std::optional<int64_t> end_ns() const;  // time of the last selected message
  DropCounts problems() const;            // what was left out

 private:
  struct Chunk {
    uint64_t at = 0;  // in the file
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
  // The lists behind the chunk at a place, one for each of its connections. Returns where they end.
  uint64_t ReadChunkIndex(uint64_t place, uint32_t lists);
  void AddEntry(const char* bytes, uint32_t connection, uint64_t chunk_size);
  BagMessage ReadMessage(const Entry& entry, const Chunk& chunk);
  // The content of a packed chunk; where it does not unpack, all of it is left out.
  BagBytes& Unpack(uint32_t number);
  std::string Describe(const std::string& error, const Chunk& chunk) const;

  std::string name_;
  BagFile file_;
  std::map<uint32_t, TypedTopic> connections_;
  std::vector<Chunk> chunks_;
  std::vector<Entry> entries_;  // of the selected topics, by time
  size_t next_ = 0;
  // Several, as topics that were written one after the other lie in different chunks; the one used
  // last is the last.
  std::vector<UnpackedChunk> unpacked_;
  DropCount of_another_type_{"messages_of_another_type", 0, ""};
  int64_t damaged_ = 0;
  std::string problem_;
};

}  // namespace plm_vins
