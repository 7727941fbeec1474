// SPDX-License-Identifier: BSD-3-Clause
#include "offline/ros/indexed_bag.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <iterator>
#include <stdexcept>

namespace plm_vins {
namespace {

constexpr char kSignature[] = "#ROSBAG V2.0\n";
constexpr uint64_t kFirstRecord = sizeof(kSignature) - 1;
constexpr uint64_t kIndexEntrySize = 12;  // seconds, nanoseconds, offset in the chunk
constexpr int64_t kSecond_ns = 1'000'000'000;
constexpr size_t kMaxUnpacked = 4;  // cached chunks, mostly below 1 MB each

// Returns whether the topic exists, with any type.
bool HasTopic(const TypedTopics& topics, const std::string& topic) {
  return std::any_of(topics.begin(), topics.end(),
                     [&](const TypedTopic& typed) { return typed.first == topic; });
}

}  // namespace

IndexedBag::IndexedBag(const std::string& file) : name_(file), file_(file) {
  if (file_.Read(0, kFirstRecord) != kSignature) throw std::runtime_error("another signature");
  const BagRecord head = file_.ReadRecord(BagOp::kBag, kFirstRecord);
  const auto encryptor = head.fields.find("encryptor");
  if (encryptor != head.fields.end() && !encryptor->second.empty()) {
    throw std::runtime_error("encrypted by " + encryptor->second);
  }
  ReadIndex(head);
}

TypedTopics IndexedBag::topics() const {
  TypedTopics topics;
  for (const auto& [id, topic] : connections_) topics.insert(topic);
  return topics;
}

void IndexedBag::Select(const TypedTopics& topics) {
  const auto is_other = [&](const Entry& entry) {
    const TypedTopic& topic = connections_.at(entry.connection);
    const bool is_selected = topics.count(topic) > 0;
    if (!is_selected && HasTopic(topics, topic.first)) {
      of_another_type_.Add(topic.second + " on " + topic.first);
    }
    return !is_selected;
  };
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(), is_other), entries_.end());
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.t_ns < b.t_ns; });
}

std::optional<BagMessage> IndexedBag::Next() {
  while (next_ < entries_.size()) {
    const Entry& entry = entries_[next_++];
    const Chunk& chunk = chunks_[entry.chunk];
    if (chunk.damaged) continue;
    try {
      return ReadMessage(entry, chunk);
    } catch (const std::exception& error) {  // exceptions of bag parsing, or std::bad_alloc
      if (damaged_++ == 0) problem_ = Describe(error.what(), chunk);
    }
  }
  unpacked_.clear();  // another bag may follow
  return std::nullopt;
}

std::optional<int64_t> IndexedBag::next_ns() const {
  if (next_ == entries_.size()) return std::nullopt;
  return entries_[next_].t_ns;
}

std::optional<int64_t> IndexedBag::end_ns() const {
  if (entries_.empty()) return std::nullopt;
  return entries_.back().t_ns;
}

DropCounts IndexedBag::problems() const {
  return {{"bag_damaged", damaged_, problem_}, of_another_type_};
}

void IndexedBag::ReadIndex(const BagRecord& head) {
  uint64_t at = head.Field<uint64_t>("index_pos");
  if (at == 0) throw std::runtime_error("no index");
  for (uint32_t i = head.Field<uint32_t>("conn_count"); i > 0; --i) {
    const BagRecord record = file_.ReadRecord(BagOp::kConnection, at);
    const BagFields about = ParseBagFields(file_.Read(record.data, record.end - record.data));
    const auto type = about.find("type");
    if (type == about.end()) throw std::runtime_error("a topic without a type");
    connections_[record.Field<uint32_t>("conn")] = {record.Text("topic"), type->second};
    at = record.end;
  }
  std::multimap<uint64_t, uint32_t> chunks;  // offset -> number of index records
  for (uint32_t i = head.Field<uint32_t>("chunk_count"); i > 0; --i) {
    const BagRecord info = file_.ReadRecord(BagOp::kChunkInfo, at);
    chunks.emplace(info.Field<uint64_t>("chunk_pos"), info.Field<uint32_t>("count"));
    at = info.end;
  }
  // Rejects overlapping chunks: a small file could otherwise require any amount of time and memory.
  uint64_t end = 0;
  for (const auto& [place, lists] : chunks) {
    if (place < end) throw std::runtime_error("chunks that overlap");
    end = ReadChunkIndex(place, lists);
  }
}

uint64_t IndexedBag::ReadChunkIndex(uint64_t place, uint32_t lists) {
  chunks_.push_back({place, file_.ReadRecord(BagOp::kChunk, place)});
  const Chunk& chunk = chunks_.back();
  const uint64_t size = chunk.is_packed() ? chunk.record.Field<uint32_t>("size")
                                          : chunk.record.end - chunk.record.data;
  uint64_t at = chunk.record.end;
  for (; lists > 0; --lists) {
    const BagRecord list = file_.ReadRecord(BagOp::kIndex, at);
    const auto connection = list.Field<uint32_t>("conn");
    const std::string bytes = file_.Read(list.data, list.end - list.data);
    if (connections_.count(connection) == 0 ||
        bytes.size() != kIndexEntrySize * list.Field<uint32_t>("count")) {
      throw std::runtime_error("a bad list of messages");
    }
    for (size_t entry = 0; entry < bytes.size(); entry += kIndexEntrySize) {
      AddEntry(bytes.data() + entry, connection, size);
    }
    at = list.end;
  }
  return at;
}

void IndexedBag::AddEntry(const char* bytes, uint32_t connection, uint64_t chunk_size) {
  uint32_t values[3];
  std::memcpy(values, bytes, kIndexEntrySize);
  const auto [seconds, nanoseconds, offset] = values;
  if (offset >= chunk_size) throw std::runtime_error("a message beyond the end of its chunk");
  entries_.push_back({seconds * kSecond_ns + nanoseconds, connection,
                      static_cast<uint32_t>(chunks_.size() - 1), offset});
}

BagMessage IndexedBag::ReadMessage(const Entry& entry, const Chunk& chunk) {
  const bool is_packed = chunk.is_packed();
  BagBytes& bytes = is_packed ? Unpack(entry.chunk) : file_;
  const uint64_t begin = is_packed ? 0 : chunk.record.data;
  const uint64_t end = is_packed ? bytes.size() : chunk.record.end;
  const BagRecord record = bytes.ReadRecord(BagOp::kMessage, begin + entry.offset, end);
  if (record.Field<uint32_t>("conn") != entry.connection) {
    throw std::runtime_error("a message of another topic");
  }
  return {connections_.at(entry.connection), bytes.Read(record.data, record.end - record.data)};
}

BagBytes& IndexedBag::Unpack(uint32_t number) {
  const auto at_hand = std::find_if(unpacked_.begin(), unpacked_.end(),
                                    [&](const UnpackedChunk& one) { return one.number == number; });
  if (at_hand != unpacked_.end()) {
    std::rotate(at_hand, std::next(at_hand), unpacked_.end());
  } else {
    if (unpacked_.size() == kMaxUnpacked) unpacked_.erase(unpacked_.begin());
    Chunk& chunk = chunks_[number];
    chunk.damaged = true;
    unpacked_.push_back({number, UnpackChunk(chunk.record, &file_)});
    chunk.damaged = false;
  }
  return *unpacked_.back().bytes;
}

std::string IndexedBag::Describe(const std::string& error, const Chunk& chunk) const {
  const std::string text = name_ + ", chunk at byte " + std::to_string(chunk.at) + ": " + error;
  return chunk.damaged ? text : text + "; \"rosbag reindex " + name_ + "\" may help";
}

}  // namespace plm_vins
