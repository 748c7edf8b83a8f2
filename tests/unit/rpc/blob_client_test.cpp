#include "rpc/blob_client.h"

#include <vector>

#include <gtest/gtest.h>

namespace radfarm::rpc {
namespace {

TEST(BlobRef, IsTheSameInPieces) {
  const std::vector<std::byte> bytes((std::size_t{64} << 20U) + 1, std::byte{7});  // two pieces
  std::size_t reports = 0;
  const Progress progress([&](std::string_view, std::uint64_t, std::uint64_t) { ++reports; });
  EXPECT_EQ(blob_ref(bytes, progress), blob_ref(bytes));
  EXPECT_EQ(reports, 2U);
  EXPECT_EQ(blob_ref({}, progress), blob_ref({}));
}

TEST(BlobRef, EndsWhenCancelled) {
  const std::vector<std::byte> bytes(std::size_t{256} << 20U);
  std::stop_source stop;
  std::size_t reports = 0;
  const Progress progress(
      [&](std::string_view, std::uint64_t, std::uint64_t) {
        if (++reports == 2) stop.request_stop();
      },
      stop.get_token());
  const Result<BlobRef> cancelled = blob_ref(bytes, progress);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, Code::kCancelled);
  EXPECT_EQ(reports, 2U);
}

}  // namespace
}  // namespace radfarm::rpc
