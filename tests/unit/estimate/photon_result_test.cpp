#include "estimate/photon_result.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(PhotonResult, RoundTripKeepsEverything) {
  PhotonResult result{1000, {}};
  for (int i = 0; i < 5; ++i) result.pixels.push_back({Spectrum(static_cast<float>(i)), Spectrum(1.0F), {1, 2, 3}});
  const auto bytes = encode(result);
  const auto again = decode_photon_result(bytes);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, result);
  EXPECT_FALSE(decode_photon_result(std::span(bytes).first(bytes.size() / 2)));
}

}  // namespace
}  // namespace radfarm
