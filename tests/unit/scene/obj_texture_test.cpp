#include "scene/obj_texture.h"

#include <gmock/gmock.h>

#include "scene/scene_files.h"
#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using Texel = std::array<std::uint8_t, 4>;

/// A 24-bit TGA image of grey values in one row.
std::string grey_tga(const std::vector<std::uint8_t>& greys) {
  std::string bytes(18, '\0');
  bytes[2] = 2;
  bytes[12] = static_cast<char>(greys.size());
  bytes[14] = 1;
  bytes[16] = 24;
  for (const std::uint8_t grey : greys) bytes += std::string(3, static_cast<char>(grey));
  return bytes;
}

/// A textured triangle whose material has these lines; color.png is red, green; mask.tga is 255, 51.
Result<Scene> load_lines(const std::string& lines) {
  const test::Folder folder;
  folder.write("color.png", test::tiny_png());
  folder.write("mask.tga", grey_tga({255, 51}));
  folder.write("large.tga", grey_tga({0, 0, 0}));
  folder.write("scene.mtl", "newmtl a\nKd 1 1 1\n" + lines);
  return load_scene(folder.write(
      "scene.obj", "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.75\nusemtl a\nf 1/1 2/1 3/1\n"));
}

TEST(ObjTexture, OffsetAndScaleBecomeTheMap) {
  const Result<Scene> scene = load_lines("map_Kd -o 0.1 0.2 0 -s 2 4 1 color.png\n");
  ASSERT_TRUE(scene) << scene.error().message;
  // v counted upwards: v' = 4 v + 0.2; ours is 1 - v' = 4 (1 - v) + 1 - 4 - 0.2.
  const float expected[6] = {2, 0, 0.1F, 0, 4, -3.2F};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(scene->materials[0].base_texture.map[i], expected[i], 1e-6F) << i;
  EXPECT_TRUE(scene->notes.empty());
}

TEST(ObjTexture, CutOutsBecomeTheAlphaOfTheBaseTexture) {
  const Result<Scene> scene = load_lines("map_Kd color.png\nmap_d mask.tga\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[0].alpha_mode, Material::Alpha::kBlend);
  ASSERT_EQ(scene->textures.size(), 1U);
  EXPECT_THAT(scene->textures[0].texels, ElementsAre(Texel{255, 0, 0, 255}, Texel{0, 255, 0, 51}));
}

TEST(ObjTexture, ACutOutAloneLeavesTheColourAsItIs) {
  const Result<Scene> scene = load_lines("map_d mask.tga\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->textures[0].texels, ElementsAre(Texel{255, 255, 255, 255}, Texel{255, 255, 255, 51}));
}

TEST(ObjTexture, ACutOutOfAnotherSizeIsLeftOutWithANote) {
  const Result<Scene> scene = load_lines("map_Kd color.png\nmap_d large.tga\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->textures[0].texels[0], (Texel{255, 0, 0, 255}));
  EXPECT_THAT(scene->notes, Contains(HasSubstr("map_d")));
}

TEST(ObjTexture, BumpsBecomeNormalsAndNormalsStay) {
  const Result<Scene> bump = load_lines("map_Bump -bm 2 mask.tga\n");
  ASSERT_TRUE(bump) << bump.error().message;
  const TextureUse& use = bump->materials[0].normal_texture;
  ASSERT_TRUE(use.is_used());
  EXPECT_FALSE(bump->textures[use.texture].is_srgb);
  EXPECT_GT(bump->textures[use.texture].texels[0][2], 128);
  EXPECT_FALSE(bump->meshes[0].uv[0].empty());
  const Result<Scene> norm = load_lines("norm color.png\nbump mask.tga\n");
  ASSERT_TRUE(norm) << norm.error().message;
  ASSERT_EQ(norm->textures.size(), 1U);
  EXPECT_EQ(norm->textures[0].texels[0], (Texel{255, 0, 0, 255}));
  EXPECT_FALSE(norm->textures[0].is_srgb);
}

TEST(ObjTexture, KsMayHaveATextureAndGlossTexturesLeaveANote) {
  const Result<Scene> scene = load_lines("Ks 0.1 0.1 0.1\nmap_Ks color.png\nmap_Ns none.png\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->materials[0].specular_color_texture.is_used());
  EXPECT_THAT(scene->notes, Contains(HasSubstr("map_Ns")));
  EXPECT_FALSE(load_lines("map_Ks color.png\n")->materials[0].specular_color_texture.is_used()) << "Ks is black";
}

TEST(ObjTexture, EveryTextureThatIsReadIsAFileOfTheScene) {
  const test::Folder folder;
  folder.write("scene.mtl",
               "newmtl a\nmap_Kd 1.png\nmap_Ke 2.png\nmap_Ks 3.png\nmap_d 4.png\nmap_Bump 5.png\nnorm 6.png\n");
  const auto files = scene_files(folder.write("scene.obj", "mtllib scene.mtl\n"));
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_EQ(files->size(), 8U);
}

}  // namespace
}  // namespace radfarm
