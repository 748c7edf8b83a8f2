#include "scene/gltf_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

namespace radfarm {
namespace {

using testing::HasSubstr;

std::string word(std::uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}

std::string chunk(std::string_view type, std::string_view data) {
  return word(static_cast<std::uint32_t>(data.size())) + std::string(type) + std::string(data);
}

std::string glb(const std::string& chunks) {
  return "glTF" + word(2) + word(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

const std::string kBin("BIN\0", 4);

std::string refusal(const std::string& bytes) {
  const auto source = split_gltf(bytes, "");
  return source ? "splits" : source.error().message;
}

TEST(GltfSource, SplitsABinaryFile) {
  const auto source = split_gltf(glb(chunk("JSON", R"({"a": 1} )") + chunk(kBin, "12345678")), "");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->json["a"], 1);
  EXPECT_EQ(source->binary, "12345678");
}

TEST(GltfSource, AnEmptyBinChunkAndUnknownLaterChunksAreHarmless) {
  EXPECT_EQ(refusal(glb(chunk("JSON", "{}") + chunk(kBin, "") + chunk("XXXX", "abcd"))), "splits");
}

TEST(GltfSource, RefusesDamagedContainers) {
  const std::string good = glb(chunk("JSON", "{}  ") + chunk(kBin, "1234"));
  EXPECT_EQ(refusal(good), "splits");
  for (std::size_t size = 4; size < good.size(); ++size) EXPECT_NE(refusal(good.substr(0, size)), "splits") << size;
  EXPECT_THAT(refusal(glb(chunk(kBin, "1234") + chunk("JSON", "{}"))), HasSubstr("one JSON chunk"));
  EXPECT_THAT(refusal(glb(chunk("JSON", "{}") + chunk("JSON", "{}"))), HasSubstr("one JSON chunk"));
  EXPECT_THAT(refusal(glb(chunk("JSON", "{}") + chunk(kBin, "") + chunk(kBin, ""))), HasSubstr("one BIN chunk"));
}

TEST(GltfSource, NamesTheLineOfBrokenJson) { EXPECT_EQ(refusal("{\n\"a\": ,\n}"), "line 2: is not JSON"); }

TEST(GltfSource, RefusesDeepNestingBeforeAnyoneRecurses) {
  EXPECT_THAT(refusal(std::string(100000, '[')), HasSubstr("nested deeper than 100"));
  EXPECT_EQ(refusal(R"({"text": "[[[[\"[[["})"), "splits");
}

TEST(GltfSource, RefusesNumbersThatAreInfinite) { EXPECT_THAT(refusal("{\"a\": 1e999}"), HasSubstr("too large")); }

}  // namespace
}  // namespace radfarm
