#include "scene/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(Reference, PathsBelowTheFolderAreDecoded) {
  EXPECT_EQ(path_of_uri("textures/oak%20wood.png")->string(), "textures/oak wood.png");
  EXPECT_EQ(path_of_uri("./a.bin")->string(), "a.bin");
  EXPECT_EQ(path_of_name("tex\\oak.png")->string(), "tex/oak.png");
  EXPECT_EQ(path_of_name("100%.png")->string(), "100%.png");
}

TEST(Reference, WhateverLeavesTheFolderIsRefused) {
  for (const char* uri : {"", "/etc/passwd", "../up.bin", "a/../../up.bin", "%2e%2e/up.bin", "a/%2E%2e/%2e%2e/b",
                          "file:///etc/passwd", "http://host/a.png", "C:/a.png", "%2fetc%2fpasswd", "a%00b", "a%zz",
                          "a%2", "..\\up.bin"}) {
    EXPECT_FALSE(path_of_uri(uri)) << uri;
  }
  EXPECT_FALSE(path_of_name("..\\..\\up.png"));
  EXPECT_FALSE(path_of_name("C:\\up.png"));
}

TEST(Reference, DataUrisAreDecoded) {
  EXPECT_EQ(*decode_data_uri("data:application/octet-stream;base64,aGVsbG8="), "hello");
  EXPECT_EQ(*decode_data_uri("data:;base64,aGVsbG8"), "hello");
  EXPECT_FALSE(decode_data_uri("data:text/plain,hello"));
  EXPECT_FALSE(decode_data_uri("data:;base64,a*b"));
}

TEST(Reference, MessagesStayOnOneLine) {
  const auto path = path_of_uri("/a\nb");
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace radfarm
