#include "scene/gltf_accessor.h"

#include <gmock/gmock.h>

#include <limits>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using test::GltfBuilder;
using testing::ElementsAre;
using testing::FloatEq;
using testing::HasSubstr;

GltfModel parse(const GltfBuilder& gltf) {
  auto source = split_gltf(gltf.document.dump(), "");
  auto model = parse_gltf(std::move(*source));
  EXPECT_TRUE(model) << model.error().message;
  return std::move(*model);
}

TEST(GltfAccessor, NormalizedIntegersBecomeFractions) {
  GltfBuilder gltf;
  gltf.add<std::uint8_t>({0, 255, 51}, 5121, "SCALAR", 3);
  gltf.add<std::int8_t>({-128, 127, 0}, 5120, "SCALAR", 3);
  gltf.add<std::uint16_t>({65535, 0}, 5123, "SCALAR", 2);
  gltf.add<std::int16_t>({-32768, 32767}, 5122, "SCALAR", 2);
  for (auto& accessor : gltf.document["accessors"]) accessor["normalized"] = true;
  const GltfModel model = parse(gltf);
  EXPECT_THAT(*read_floats(model, 0, 1), ElementsAre(0.0F, 1.0F, FloatEq(0.2F)));
  EXPECT_THAT(*read_floats(model, 1, 1), ElementsAre(-1.0F, 1.0F, 0.0F));
  EXPECT_THAT(*read_floats(model, 2, 1), ElementsAre(1.0F, 0.0F));
  EXPECT_THAT(*read_floats(model, 3, 1), ElementsAre(-1.0F, 1.0F));
}

TEST(GltfAccessor, IntegersThatAreNotNormalizedKeepTheirValues) {
  GltfBuilder gltf;
  gltf.add<std::int16_t>({-5, 700, 3}, 5122, "VEC3", 1);
  EXPECT_THAT(*read_floats(parse(gltf), 0, 3), ElementsAre(-5.0F, 700.0F, 3.0F));
}

TEST(GltfAccessor, MissingAlphaIsOne) {
  GltfBuilder gltf;
  gltf.add_vec3({.1F, .2F, .3F});
  EXPECT_THAT(*read_floats(parse(gltf), 0, 4), ElementsAre(.1F, .2F, .3F, 1.0F));
}

TEST(GltfAccessor, StridesSkipWhatLiesBetween) {
  GltfBuilder gltf;
  gltf.add<float>({1, 2, 99, 3, 4, 99}, 5126, "VEC2", 2);
  gltf.document["bufferViews"][0]["byteStride"] = 12;
  EXPECT_THAT(*read_floats(parse(gltf), 0, 2), ElementsAre(1.0F, 2.0F, 3.0F, 4.0F));
}

TEST(GltfAccessor, SparseValuesReplaceDenseOnesOrZeros) {
  GltfBuilder gltf;
  gltf.add<float>({1, 2, 3}, 5126, "SCALAR", 3);
  gltf.add<std::uint8_t>({1}, 5121, "SCALAR", 1);
  gltf.add<float>({20}, 5126, "SCALAR", 1);
  gltf.document["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                             {"values", {{"bufferView", 2}}}};
  EXPECT_THAT(*read_floats(parse(gltf), 0, 1), ElementsAre(1.0F, 20.0F, 3.0F));
  gltf.document["accessors"][0].erase("bufferView");
  EXPECT_THAT(*read_floats(parse(gltf), 0, 1), ElementsAre(0.0F, 20.0F, 0.0F));
}

TEST(GltfAccessor, ASparseIndexOutOfRangeIsAnError) {
  GltfBuilder gltf;
  gltf.add<float>({1, 2, 3}, 5126, "SCALAR", 3);
  gltf.add<std::uint8_t>({3}, 5121, "SCALAR", 1);
  gltf.document["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                             {"values", {{"bufferView", 0}}}};
  const auto values = read_floats(parse(gltf), 0, 1);
  ASSERT_FALSE(values);
  EXPECT_EQ(values.error().message, "/accessors/0/sparse: sparse index 3 is out of range (there are 3 elements)");
}

TEST(GltfAccessor, ValuesThatAreNotFiniteAreAnError) {
  GltfBuilder gltf;
  gltf.add_vec3({0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0});
  const auto values = read_floats(parse(gltf), 0, 3);
  ASSERT_FALSE(values);
  EXPECT_EQ(values.error().message, "/accessors/0: element 1 is not finite");
}

TEST(GltfAccessor, IndicesOfEveryUnsignedTypeAreRead) {
  GltfBuilder gltf;
  gltf.add<std::uint8_t>({0, 250}, 5121, "SCALAR", 2);
  gltf.add<std::uint16_t>({1, 60000}, 5123, "SCALAR", 2);
  gltf.add<std::uint32_t>({2, 4000000000U}, 5125, "SCALAR", 2);
  const GltfModel model = parse(gltf);
  EXPECT_THAT(read_indices(model, 0), ElementsAre(0U, 250U));
  EXPECT_THAT(read_indices(model, 1), ElementsAre(1U, 60000U));
  EXPECT_THAT(read_indices(model, 2), ElementsAre(2U, 4000000000U));
}

}  // namespace
}  // namespace radfarm
