#include "scene/light_scene.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using testing::HasSubstr;

/// 2 x 1 pixels of 0.5 in red, RGBE without runs.
std::string tiny_hdr() {
  const std::string pixel("\x80\0\0\x80", 4);
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + pixel + pixel;
}

/// 10 cd in all directions downwards.
constexpr const char* kIes = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n10 10\n";

Scene lit_scene() {
  Scene scene;
  for (const char* name : {"desk", "ceiling", "ceiling", "sun"}) {
    scene.lights.emplace_back();
    scene.lights.back().name = name;
    scene.lights.back().intensity = {4, 2, 1};
  }
  scene.lights.back().kind = PunctualLight::Kind::kDirectional;
  return scene;
}

/// The error's message, or "no error".
std::string refusal(const AddedLight& added, Scene scene = lit_scene()) {
  const test::Folder folder;
  const std::filesystem::path file = folder.write("good.ies", kIes);
  folder.write("bad.ies", "no photometry");
  folder.write("bad.hdr", "no picture");
  const Status status = light_scene(added, file.parent_path(), scene);
  return status ? "no error" : status.error().message;
}

TEST(LightScene, NothingAddedChangesNothing) {
  Scene scene = lit_scene();
  ASSERT_TRUE(light_scene({}, "/nonexistent", scene));
  EXPECT_TRUE(scene.environment.is_empty());
  EXPECT_TRUE(scene.photometries.empty());
}

TEST(LightScene, AMapIsFoundBesideTheSceneOrByItsWholePath) {
  const test::Folder folder;
  const std::filesystem::path file = folder.write("maps/tiny.hdr", tiny_hdr());
  for (const std::string& name : {std::string("maps/tiny.hdr"), file.string()}) {
    Scene scene;
    const Status status = light_scene({name, {}}, file.parent_path().parent_path(), scene);
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_EQ(scene.environment.width, 2U);
    EXPECT_EQ(scene.environment.height, 1U);
    EXPECT_EQ(scene.environment.radiance.at(0), Spectrum(0.5F, 0, 0));
  }
}

TEST(LightScene, ASkyNeedsNoFile) {
  Scene scene;
  ASSERT_TRUE(light_scene({"sky:uniform,luminance=5,ground=0", {}}, "/nonexistent", scene));
  EXPECT_EQ(scene.environment.width, 512U);
}

TEST(LightScene, APhotometryGoesToEveryLightOfItsNameAndKeepsTheirColour) {
  const test::Folder folder;
  const std::filesystem::path file = folder.write("lamp.ies", kIes);
  Scene scene = lit_scene();
  const Status status =
      light_scene({"", {{"ceiling", "lamp.ies"}, {"desk", file.string()}}}, file.parent_path(), scene);
  ASSERT_TRUE(status) << status.error().message;
  ASSERT_EQ(scene.photometries.size(), 2U);
  EXPECT_EQ(scene.photometries[0].name, "lamp.ies");
  EXPECT_EQ(scene.lights[0].photometry, 1U);
  EXPECT_EQ(scene.lights[1].photometry, 0U);
  EXPECT_EQ(scene.lights[2].photometry, 0U);
  EXPECT_EQ(scene.lights[3].photometry, kNone);
  for (const std::size_t i : {0U, 1U, 2U}) {
    EXPECT_NEAR(luminance(scene.lights[i].intensity), 1, 1e-6F);
    EXPECT_NEAR(scene.lights[i].intensity.r, 4 * scene.lights[i].intensity.b, 1e-5F);
  }
}

TEST(LightScene, ABlackLightBecomesWhite) {
  const test::Folder folder;
  const std::filesystem::path file = folder.write("lamp.ies", kIes);
  Scene scene = lit_scene();
  scene.lights[0].intensity = {};
  ASSERT_TRUE(light_scene({"", {{"desk", "lamp.ies"}}}, file.parent_path(), scene));
  EXPECT_EQ(scene.lights[0].intensity, Spectrum(1.0F));
}

TEST(LightScene, AnUnknownNameListsThoseThatThereAre) {
  EXPECT_THAT(refusal({"", {{"lamp", "good.ies"}}}),
              testing::AllOf(HasSubstr("'lamp'"), HasSubstr("'desk'"), HasSubstr("'ceiling'")));
  EXPECT_THAT(refusal({"", {{"lamp", "good.ies"}}}, Scene()), HasSubstr("KHR_lights_punctual"));
  EXPECT_THAT(refusal({"", {{"sun", "good.ies"}}}), HasSubstr("no point or spot light is called 'sun'"));
}

TEST(LightScene, BadFilesAreNamedWithTheirFlag) {
  EXPECT_THAT(refusal({"", {{"desk", "bad.ies"}}}), testing::AllOf(HasSubstr("--ies"), HasSubstr("bad.ies")));
  EXPECT_THAT(refusal({"", {{"desk", "missing.ies"}}}), HasSubstr("missing.ies"));
  EXPECT_THAT(refusal({"bad.hdr", {}}), testing::AllOf(HasSubstr("--env"), HasSubstr("bad.hdr")));
  EXPECT_THAT(refusal({"missing.hdr", {}}), HasSubstr("missing.hdr"));
  EXPECT_THAT(refusal({"sky:no_such_key=1", {}}), testing::AllOf(HasSubstr("--env"), HasSubstr("no_such_key")));
}

}  // namespace
}  // namespace radfarm
