#include "rpc/channel.h"

#include <gtest/gtest.h>

namespace radfarm::rpc {
namespace {

TEST(CheckAddress, WantsHostAndPort) {
  EXPECT_TRUE(check_address("127.0.0.1:0", "--listen"));
  EXPECT_TRUE(check_address("farm.example:65535", "--listen"));
  for (const char* wrong : {"", ":", "host", "host:", ":80", "host:65536", "host:-1", "host:8o", "host:80 "}) {
    const Status status = check_address(wrong, "--listen");
    ASSERT_FALSE(status) << wrong;
    EXPECT_NE(status.error().message.find("--listen"), std::string::npos);
  }
}

}  // namespace
}  // namespace radfarm::rpc
