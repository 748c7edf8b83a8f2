#include "base/flat_file.h"

#include <cstring>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

struct Item {
  std::uint32_t id;
  float value;
};

/// Flat files are used in place, so tests keep their bytes on the alignment that mapped memory has.
class AlignedBytes {
 public:
  explicit AlignedBytes(std::span<const std::byte> bytes) : storage_(bytes.size() / 64 + 1), size_(bytes.size()) {
    if (size_ > 0) std::memcpy(storage_.data(), bytes.data(), size_);
  }
  std::span<const std::byte> view() const { return std::as_bytes(std::span(storage_)).first(size_); }

 private:
  struct alignas(64) Block {
    std::byte bytes[64];
  };
  std::vector<Block> storage_;
  std::size_t size_;
};

std::vector<std::byte> example() {
  FlatFileWriter writer("test", 3);
  writer.add("items", std::vector<Item>{{1, 0.5F}, {2, -0.25F}});
  writer.add_text("text", "caf\xc3\xa9");
  writer.add("empty", std::vector<double>{});
  writer.add_value("value", std::uint64_t{77});
  return writer.finish();
}

/// Opens, and reads everything that opens: whatever the bytes are, no read may leave them (run under ASan).
void read_all(std::span<const std::byte> bytes) {
  const Result<FlatFileReader> reader = FlatFileReader::open(bytes, "test", 3);
  if (!reader) return;
  if (const auto items = reader->get<Item>("items")) {
    std::uint32_t sum = 0;
    for (const Item& item : *items) sum += item.id;
    EXPECT_EQ(sum, sum);
  }
  (void)reader->get_text("text");
  (void)reader->copy<double>("empty");
  (void)reader->get_value<std::uint64_t>("value");
}

TEST(FlatFile, WhatWasAddedIsReadInPlace) {
  const AlignedBytes bytes(example());
  const FlatFileReader reader = FlatFileReader::open(bytes.view(), "test", 3).value();
  const auto items = reader.get<Item>("items").value();
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[1].value, -0.25F);
  EXPECT_GE(reinterpret_cast<const std::byte*>(items.data()), bytes.view().data());
  EXPECT_EQ(reader.get_text("text").value(), "caf\xc3\xa9");
  EXPECT_TRUE(reader.get<double>("empty").value().empty());
  EXPECT_EQ(reader.get_value<std::uint64_t>("value").value(), 77U);
}

TEST(FlatFile, SameContentsGiveTheSameBytes) { EXPECT_EQ(example(), example()); }

TEST(FlatFile, WrongKindVersionNameOrTypeIsDataLoss) {
  const AlignedBytes bytes(example());
  EXPECT_EQ(FlatFileReader::open(bytes.view(), "other", 3).error().code, Code::kDataLoss);
  const Result<FlatFileReader> newer = FlatFileReader::open(bytes.view(), "test", 4);
  ASSERT_FALSE(newer);
  EXPECT_THAT(newer.error().message, testing::AllOf(testing::HasSubstr("3"), testing::HasSubstr("4")));
  const FlatFileReader reader = FlatFileReader::open(bytes.view(), "test", 3).value();
  EXPECT_EQ(reader.get<Item>("nothing").error().code, Code::kDataLoss);
  EXPECT_EQ(reader.get<std::uint32_t>("items").error().code, Code::kDataLoss);
  EXPECT_EQ(reader.get_value<Item>("items").error().code, Code::kDataLoss);
}

TEST(FlatFile, EveryTruncationIsSafe) {
  const std::vector<std::byte> whole = example();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const AlignedBytes bytes(std::span<const std::byte>(whole).first(size));
    read_all(bytes.view());
  }
}

TEST(FlatFile, HostileTablesAreSafe) {
  const std::vector<std::byte> whole = example();
  RandomSequence random(11);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::byte> damaged = whole;
    for (std::uint64_t k = random.bits() % 4 + 1; k > 0; --k) {
      damaged[random.bits() % 300] = std::byte{static_cast<unsigned char>(random.bits())};
    }
    const AlignedBytes bytes(damaged);
    read_all(bytes.view());
  }
}

TEST(FlatFile, OffsetsThatWrapAroundAreRefused) {
  std::vector<std::byte> damaged = example();
  const std::uint64_t offset = ~std::uint64_t{63}, size = 128;
  std::memcpy(damaged.data() + 24 + 24, &offset, 8);  // the first entry's offset and size
  std::memcpy(damaged.data() + 24 + 32, &size, 8);
  const AlignedBytes bytes(damaged);
  EXPECT_EQ(FlatFileReader::open(bytes.view(), "test", 3).error().code, Code::kDataLoss);
}

}  // namespace
}  // namespace radfarm
