#include "base/file.h"

#include <filesystem>
#include <fstream>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace radfarm {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  FileTest() : directory_(TemporaryDirectory::create("radfarm-file-test").value()) {}
  fs::path path(const char* name) const { return directory_.path() / name; }
  TemporaryDirectory directory_;
};

TEST_F(FileTest, WhatWasWrittenIsRead) {
  const std::string text("a\0b\n", 4);
  ASSERT_TRUE(write_file_atomically(path("x"), text));
  EXPECT_EQ(read_file(path("x"), 100).value(), text);
}

TEST_F(FileTest, WritingReplacesTheWholeFileAndLeavesNothingBeside) {
  ASSERT_TRUE(write_file_atomically(path("x"), "a long first content"));
  ASSERT_TRUE(write_file_atomically(path("x"), "short"));
  EXPECT_EQ(read_file(path("x"), 100).value(), "short");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_.path()), fs::directory_iterator()), 1);
}

TEST_F(FileTest, FailedWriteLeavesTheOldTargetAndNoTemporary) {
  fs::create_directory(path("d"));
  std::ofstream(path("d") / "inside") << "x";
  const Status status = write_file_atomically(path("d"), "text");  // a file cannot replace a folder
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, testing::HasSubstr(path("d").string()));
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_.path()), fs::directory_iterator()), 1);
}

TEST_F(FileTest, MissingFolderIsNotFound) {
  EXPECT_EQ(write_file_atomically(path("no/such/file"), "x").error().code, Code::kNotFound);
}

TEST_F(FileTest, ReadingNamesTheFileAndTheCause) {
  const Result<std::string> missing = read_file(path("missing"), 100);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, Code::kNotFound);
  EXPECT_THAT(missing.error().message, testing::HasSubstr("missing"));
  ASSERT_TRUE(write_file_atomically(path("big"), std::string(101, 'x')));
  EXPECT_EQ(read_file(path("big"), 100).error().code, Code::kResourceExhausted);
  EXPECT_EQ(read_file(directory_.path(), 100).error().code, Code::kInvalidArgument);
}

TEST_F(FileTest, MappedFileShowsTheBytesAndMoves) {
  ASSERT_TRUE(write_file_atomically(path("x"), "abc"));
  MappedFile mapped = MappedFile::open(path("x")).value();
  const MappedFile moved = std::move(mapped);
  ASSERT_EQ(moved.bytes().size(), 3U);
  EXPECT_EQ(moved.bytes()[2], std::byte{'c'});
  ASSERT_TRUE(write_file_atomically(path("empty"), ""));
  EXPECT_TRUE(MappedFile::open(path("empty")).value().bytes().empty());
  EXPECT_EQ(MappedFile::open(path("missing")).error().code, Code::kNotFound);
}

TEST(TemporaryDirectory, IsRemovedWithWhatItHolds) {
  fs::path path;
  {
    const TemporaryDirectory directory = TemporaryDirectory::create("radfarm-test").value();
    path = directory.path();
    ASSERT_TRUE(write_file_atomically(path / "x", "abc"));
  }
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace radfarm
