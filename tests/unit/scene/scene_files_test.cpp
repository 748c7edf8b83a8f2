#include "scene/scene_files.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using testing::ElementsAre;

TEST(SceneFiles, AGltfFileNamesItsBuffersAndImagesDecoded) {
  const test::Folder folder;
  const auto scene = folder.write("a.gltf", R"({"buffers": [{"uri": "my%20data.bin"}, {"uri": "data:;base64,AAAA"}],
      "images": [{"uri": "tex/oak.png"}, {"bufferView": 0}, {"uri": "tex/oak.png"}]})");
  const auto files = scene_files(scene);
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_THAT(*files, ElementsAre("a.gltf", "my data.bin", "tex/oak.png"));
}

TEST(SceneFiles, AnObjFileNamesItsLibrariesAndTheirTextures) {
  const test::Folder folder;
  folder.write("lib/a.mtl", "newmtl a\nmap_Kd oak.png\nnewmtl b\nmap_Kd oak.png\n");
  const auto files = scene_files(folder.write("a.obj", "mtllib lib/a.mtl\n"));
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_THAT(*files, ElementsAre("a.obj", "lib/a.mtl", "lib/oak.png"));
}

TEST(SceneFiles, AMissingLibraryIsLeftOut) {
  const test::Folder folder;
  const auto files = scene_files(folder.write("a.obj", "mtllib none.mtl\n"));
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_THAT(*files, ElementsAre("a.obj"));
  EXPECT_FALSE(scene_files(folder.write("b.obj", "mtllib ../none.mtl\n")));
}

TEST(SceneFiles, FilesOutsideTheFolderAreRefused) {
  const test::Folder folder;
  const auto files = scene_files(folder.write("a.gltf", R"({"images": [{"uri": "%2e%2e/a.png"}]})"));
  ASSERT_FALSE(files);
  EXPECT_THAT(files.error().message, testing::HasSubstr("/images/0/uri: "));
}

}  // namespace
}  // namespace radfarm
