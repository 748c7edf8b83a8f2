#include "pipeline/solution_store.h"

#include <thread>

#include <gtest/gtest.h>

#include "base/digest.h"
#include "base/file.h"
#include "senders/sender_tree.h"

namespace radfarm {
namespace {

namespace fs = std::filesystem;

/// A tree of `patches` senders under one root.
SolvedLight light_of(std::size_t patches) {
  SenderNode leaf;
  leaf.patch = 0;
  SolvedLight light;
  light.facts = {{5, 4, 1, 0, 0.25}, patches, 7, 8, 0.5};
  light.file = encode(own_sender_tree({leaf}, std::vector<SenderPatch>(patches)));
  light.digest = sha256_hex(light.file);
  return light;
}

class SolutionStoreTest : public testing::Test {
 protected:
  static std::string key(const std::string& name) { return sha256_hex(name); }
  fs::path path_of(const std::string& name) const { return folder_.path() / "solutions" / key(name); }
  SolutionStore store(std::uint64_t bytes = 1U << 30U) const { return {folder_.path() / "solutions", bytes}; }

  TemporaryDirectory folder_ = *TemporaryDirectory::create("radfarm-solutions");
};

TEST_F(SolutionStoreTest, FindsWhatWasKept) {
  EXPECT_FALSE(store().find(key("a")));
  store().keep(key("a"), light_of(3));
  const std::optional<SolvedLight> found = store().find(key("a"));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->file, light_of(3).file);
  EXPECT_EQ(found->digest, light_of(3).digest);
  EXPECT_EQ(found->facts.links, 3U);
  EXPECT_EQ(found->facts.iterations, 8U);
  EXPECT_EQ(found->facts.energy.closure_error, 0.25);
  EXPECT_EQ(found->facts.mean_radiance, 0.5);
  EXPECT_FALSE(store().find(key("b")));
}

TEST_F(SolutionStoreTest, KeepsNothingWithoutAPlaceAndNeverFails) {
  const SolutionStore none;
  EXPECT_FALSE(none.keeps());
  none.keep(key("a"), light_of(1));
  EXPECT_FALSE(none.find(key("a")));
  ASSERT_TRUE(write_file_atomically(folder_.path() / "file", std::string_view("in the way")));
  const SolutionStore blocked(folder_.path() / "file", 1U << 20U);
  blocked.keep(key("a"), light_of(1));
  EXPECT_FALSE(blocked.find(key("a")));
}

TEST_F(SolutionStoreTest, AnEntryWithAnyDamagedByteIsNotThereAndIsReplaced) {
  store().keep(key("a"), light_of(2));
  const std::string good = *read_file(path_of("a"), 1U << 20U);
  const std::size_t used = good.find_last_not_of('\0') + 1;  // behind it: zeros up to the next multiple of 64
  int ignored = 0;
  for (std::size_t i = 0; i < used; ++i) {
    std::string damaged = good;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    ASSERT_TRUE(write_file_atomically(path_of("a"), damaged));
    const std::optional<SolvedLight> found = store().find(key("a"));
    // A byte that fills a gap may change and hurts nobody.
    EXPECT_TRUE(!found || found->file == light_of(2).file) << "byte " << i;
    ignored += found ? 0 : 1;
  }
  EXPECT_GT(ignored, static_cast<int>(used / 2));
  for (std::size_t size = 0; size < used; size += 7) {
    ASSERT_TRUE(write_file_atomically(path_of("a"), std::string_view(good).substr(0, size)));
    EXPECT_FALSE(store().find(key("a"))) << "cut off after " << size;
  }
  store().keep(key("a"), light_of(2));
  EXPECT_EQ(*read_file(path_of("a"), 1U << 20U), good);
}

TEST_F(SolutionStoreTest, AnEntryUnderAnotherNameIsNotThere) {
  store().keep(key("a"), light_of(1));
  fs::rename(path_of("a"), path_of("b"));
  EXPECT_FALSE(store().find(key("b")));
}

TEST_F(SolutionStoreTest, WhatWasUsedLongestAgoGoesFirst) {
  store().keep(key("a"), light_of(1));
  const std::uint64_t size = fs::file_size(path_of("a"));
  store().keep(key("b"), light_of(1));
  // What is written within one tick of the clock is told apart by setting the times.
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(path_of("a"), now - std::chrono::hours(2));
  fs::last_write_time(path_of("b"), now - std::chrono::hours(1));
  ASSERT_TRUE(write_file_atomically(folder_.path() / "solutions" / "notes.txt", std::string_view("not ours")));
  EXPECT_TRUE(store().find(key("a"))) << "and so is used now";
  store(2 * size).keep(key("c"), light_of(1));
  EXPECT_TRUE(store().find(key("a")));
  EXPECT_FALSE(store().find(key("b")));
  EXPECT_TRUE(store().find(key("c")));
  EXPECT_TRUE(fs::exists(folder_.path() / "solutions" / "notes.txt"));
}

TEST_F(SolutionStoreTest, WhatIsLargerThanTheStoreIsNotKept) {
  store().keep(key("a"), light_of(1));
  store(100).keep(key("b"), light_of(1));
  EXPECT_TRUE(store().find(key("a")));
  EXPECT_FALSE(store().find(key("b")));
}

TEST_F(SolutionStoreTest, ManyMayWriteAndReadAtOnce) {
  const auto work = [&] {
    for (int n = 0; n < 20; ++n) {
      store().keep(key("a"), light_of(50));
      const std::optional<SolvedLight> found = store().find(key("a"));
      EXPECT_TRUE(found && found->file == light_of(50).file);
    }
  };
  std::vector<std::thread> writers;
  for (int i = 0; i < 4; ++i) writers.emplace_back(work);
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "solutions"), {}), 1) << "nothing is left beside it";
}

}  // namespace
}  // namespace radfarm
