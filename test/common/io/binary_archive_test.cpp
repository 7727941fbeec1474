// SPDX-License-Identifier: BSD-3-Clause
#include "common/io/binary_archive.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "test/testing/message_of.h"

namespace plm_vins {
namespace {

using testing::MessageOf;

enum class Kind : uint8_t { kOne = 1, kTwo = 2 };

struct Item {
  static inline int made = 0;
  Item() { ++made; }

  Kind kind = Kind::kOne;
  std::optional<double> value;
  std::string name;
};

const auto kLayout = [](auto* archive, auto& item) {
  archive->Value(item.kind);
  if (archive->Has(item.value)) archive->Value(*item.value);
  archive->List(item.name, [](auto* characters, auto& c) { characters->Value(c); });
};

TEST(BinaryArchive, SurvivesARoundTrip) {
  std::vector<Item> items(2);
  items[1].kind = Kind::kTwo;
  items[1].value = 1 / 3.0;
  items[1].name = std::string("a name\0with a zero", 18);
  std::stringstream stream;
  BinaryWriter(&stream).List(items, kLayout);
  std::vector<Item> read(7);
  BinaryReader(&stream).List(read, kLayout);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].kind, Kind::kOne);
  EXPECT_FALSE(read[0].value);
  EXPECT_EQ(read[0].name, "");
  EXPECT_EQ(read[1].kind, Kind::kTwo);
  EXPECT_EQ(read[1].value, 1 / 3.0);
  EXPECT_EQ(read[1].name, items[1].name);
}

TEST(BinaryReader, AcceptsOnlyZeroAndOneAsBool) {
  std::istringstream stream(std::string("\1\0\2\2", 4));
  BinaryReader reader(&stream);
  bool value = false;
  reader.Value(value);
  EXPECT_TRUE(value);
  reader.Value(value);
  EXPECT_FALSE(value);
  EXPECT_EQ(MessageOf([&] { reader.Value(value); }), "is damaged");
  std::optional<double> number;
  EXPECT_EQ(MessageOf([&] { reader.Has(number); }), "is damaged");
}

TEST(BinaryReader, ReportsTruncation) {
  std::istringstream stream("seven b");
  BinaryReader reader(&stream);
  double value = 0;
  EXPECT_EQ(MessageOf([&] { reader.Value(value); }), "ends too early");
}

// The count claims a million items, but there are data for two.
TEST(BinaryReader, DoesNotAllocateForMissingItems) {
  std::ostringstream written;
  BinaryWriter(&written).List(std::vector<Item>(2), kLayout);
  std::string bytes = written.str();
  bytes.replace(0, 4, std::string("\x40\x42\x0f\0", 4));
  std::istringstream stream(bytes);
  std::vector<Item> items;
  Item::made = 0;
  EXPECT_EQ(MessageOf([&] { BinaryReader(&stream).List(items, kLayout); }), "ends too early");
  EXPECT_LE(Item::made, 3);
  EXPECT_LE(items.capacity(), 1000u);
}

}  // namespace
}  // namespace plm_vins
