#include "scene/obj.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using test::Folder;
using testing::Contains;
using testing::HasSubstr;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Result<Scene> load_text(const std::string& text, LoadOptions::UpAxis up = LoadOptions::UpAxis::kY) {
  const Folder folder;
  return load_scene(folder.write("scene.obj", text), {up});
}

Result<Scene> load_with_materials(const std::string& materials, const std::string& faces = "usemtl a\nf 1 2 3\n") {
  const Folder folder;
  folder.write("scene.mtl", materials);
  folder.write("red.png", test::tiny_png());
  return load_scene(folder.write("scene.obj", "mtllib scene.mtl\n" + kTriangle + "vt 0.25 0.75\n" + faces));
}

std::string refusal(const Result<Scene>& scene) { return scene ? "loads" : scene.error().message; }

TEST(Obj, FacesWithoutMaterialAreGreyWithANote) {
  const Result<Scene> scene = load_text(kTriangle + "f 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[scene->meshes[0].material].base_color, Spectrum(0.5F));
  EXPECT_THAT(scene->notes, Contains(HasSubstr("without a material")));
}

TEST(Obj, NegativeIndicesCountFromTheLastVertex) {
  const Result<Scene> scene = load_text("v 9 9 9\n" + kTriangle + "f -3 -2 -1\nv 5 5 5\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(test::placed(*scene, 0, 1).x, 1, 1e-6);
}

TEST(Obj, PolygonsAreCutOnce) {
  const Result<Scene> scene = load_text("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].triangles.size(), 3U);
}

TEST(Obj, EachGroupAndMaterialIsAMeshOfItsOwn) {
  const Result<Scene> scene = load_with_materials(
      "newmtl a\nKd 1 1 1\nnewmtl b\nKd 0 0 0\n",
      "v 0 0 1\ng one\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\nusemtl a\nf 1 4 2\ng two\nf 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->meshes.size(), 3U);
  EXPECT_EQ(scene->meshes[0].triangles.size(), 2U);
  EXPECT_EQ(scene->meshes[1].material, 1U);
  EXPECT_EQ(scene->meshes[2].name, "two");
}

TEST(Obj, TexturesAreReadAndVIsTurnedAround) {
  const Result<Scene> scene = load_with_materials("newmtl a\nKd 1 1 1\nmap_Kd red.png\n", "usemtl a\nf 1/1 2/1 3/1\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->textures.size(), 1U);
  EXPECT_EQ(scene->meshes[0].uv[0][0], Vec2(0.25F, 0.25F));
}

TEST(Obj, MaterialFaultsNameFileLineAndMaterial) {
  EXPECT_THAT(refusal(load_with_materials("newmtl b\nnewmtl a\nKd 1.5 0 0\n")),
              HasSubstr("mtllib scene.mtl: scene.mtl: line 2: material 'a': Kd is 1.5 0 0, must be in [0, 1]"));
  EXPECT_THAT(refusal(load_with_materials("newmtl a\nmap_Kd none.png\n")), HasSubstr("material 'a': map_Kd: "));
  EXPECT_THAT(refusal(load_with_materials("newmtl a\nmap_Kd ../up.png\n")), HasSubstr("leaves the folder"));
}

TEST(Obj, AMissingLibraryIsANoteAndItsMaterialsAreGrey) {
  const Result<Scene> scene = load_text("# hello\nmtllib none.mtl\nusemtl oak\n" + kTriangle + "f 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[scene->meshes[0].material].base_color, Spectrum(0.5F));
  EXPECT_THAT(scene->notes, Contains(HasSubstr("Line 2: material library 'none.mtl' does not exist")));
  EXPECT_THAT(scene->notes, Contains(HasSubstr("Material 'oak' is not defined")));
}

TEST(Obj, OfSeveralLibrariesTheOnesThatAreThereAreRead) {
  const Folder folder;
  folder.write("b.mtl", "newmtl red\nKd 1 0 0\n");
  const Result<Scene> scene =
      load_scene(folder.write("scene.obj", "mtllib a.mtl b.mtl\nusemtl red\n" + kTriangle + "f 1 2 3\n"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[scene->meshes[0].material].base_color, Spectrum(1, 0, 0));
  EXPECT_THAT(scene->notes, Contains(HasSubstr("'a.mtl' does not exist")));
}

TEST(Obj, ALibraryOutsideTheFolderIsAnErrorWhetherItExistsOrNot) {
  for (const char* name : {"../none.mtl", "/none.mtl"}) {
    const Result<Scene> scene = load_text("# hello\nmtllib " + std::string(name) + "\n" + kTriangle + "f 1 2 3\n");
    ASSERT_FALSE(scene) << name;
    EXPECT_THAT(scene.error().message, HasSubstr("line 2: mtllib " + std::string(name) + ": "));
  }
}

TEST(Obj, ZUpTurnsTheScene) {
  const Result<Scene> scene = load_text("v 0 0 0\nv 1 0 0\nv 0 0 3\nf 1 2 3\n", LoadOptions::UpAxis::kZ);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(test::placed(*scene, 0, 2).y, 3, 1e-6);
}

TEST(Obj, NormalsMayBeMissingAtSomeCorners) {
  const Result<Scene> scene = load_text(kTriangle + "vn 0 0 2\nvn 0 0 0\nf 1//1 2 3//2\n");
  ASSERT_TRUE(scene) << scene.error().message;
  for (const Vec3& normal : scene->meshes[0].normals) EXPECT_EQ(normal, Vec3(0, 0, 1));
}

TEST(Obj, GeometryFarFromZeroKeepsItsDigits) {
  const Result<Scene> scene =
      load_text("v 1000000.001 0 0\nv 1000001.001 0 0\nv 1000000.001 1.5 0\nf 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(test::placed(*scene, 0, 0).x, 1000000.001, 1e-7);
  EXPECT_NEAR(test::placed(*scene, 0, 1).x, 1000001.001, 1e-7);
}

struct Fault {
  const char* text;
  const char* message;
};

class ObjFault : public testing::TestWithParam<Fault> {};

TEST_P(ObjFault, IsRefusedWithItsLine) {
  EXPECT_THAT(refusal(load_text(GetParam().text)), HasSubstr(std::string(": ") + GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, ObjFault,
    testing::Values(Fault{"v 0 0 nan\n", "line 1: vertex coordinate is not a finite number"},
                    Fault{"v 0 0 1e999\n", "line 1: vertex coordinate is not a finite number"},
                    Fault{"v 0 0 0\r\nv 1 2\r\n", "line 2: vertex has 2 coordinates"},
                    Fault{"v 0 0 0\nf 1 1 9\n", "line 2: vertex 9 does not exist (there are 1)"},
                    Fault{"v 0 0 0\nf 1 1 -2\n", "line 2: vertex -2 does not exist (there are 1)"},
                    Fault{"v 0 0 0\nf 1/1 1/1 1/1\n", "line 2: texture coordinate 1 does not exist (there are 0)"},
                    Fault{"v 0 0 0\nf 1//2 1 1\n", "line 2: normal 2 does not exist (there are 0)"},
                    Fault{"v 0 0 0\nf 0 1 1\n", "line 2: face index is 0"},
                    Fault{"v 0 0 0\nf 1 x 1\n", "line 2: face index is not a whole number"},
                    Fault{"v 0 0 0\nf 1 99999999999999999999 1\n", "line 2: face index is not a whole number"}));

TEST(LoadScene, UnknownFormatsListWhatIsSupported) {
  const Folder folder;
  const Result<Scene> scene = load_scene(folder.write("scene.fbx", ""));
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("'.fbx'; supported are .gltf, .glb and .obj"));
}

TEST(LoadScene, ExtensionsMayBeInCapitalsAndMissingFilesAreNotFound) {
  const Folder folder;
  EXPECT_TRUE(load_scene(folder.write("SCENE.OBJ", kTriangle + "f 1 2 3\n")));
  const Result<Scene> scene = load_scene("/nonexistent/scene.gltf");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, Code::kNotFound);
}

}  // namespace
}  // namespace radfarm
