#include "scene/image_file.h"

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

TEST(ImageFile, DecodesAPngToRgba) {
  const Result<Texture> texture = decode_image(test::tiny_png());
  ASSERT_TRUE(texture) << texture.error().message;
  EXPECT_EQ(texture->width, 2U);
  EXPECT_EQ(texture->height, 1U);
  EXPECT_EQ(texture->texels[0], (std::array<std::uint8_t, 4>{255, 0, 0, 255}));
}

TEST(ImageFile, RefusesWhatIsCutOffOrNoImage) {
  const std::string png = test::tiny_png();
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, png.size() / 2}) {
    const Result<Texture> texture = decode_image(png.substr(0, size));
    ASSERT_FALSE(texture);
    EXPECT_EQ(texture.error().code, Code::kInvalidArgument);
  }
}

TEST(ImageFile, RefusesABombByItsHeader) {
  std::string png = test::tiny_png();
  png.replace(16, 8, std::string("\0\0\xff\xdc\0\0\xff\xdc", 8));  // 65500 x 65500
  const Result<Texture> texture = decode_image(png);
  ASSERT_FALSE(texture);
  EXPECT_EQ(texture.error().code, Code::kResourceExhausted);
}

}  // namespace
}  // namespace radfarm
