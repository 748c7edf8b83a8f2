// `radfarm render` as a person runs it.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "image/exr.h"
#include "integration/processes.h"
#include "process/child_process.h"

namespace radfarm::test {
namespace {

using Exit = ChildProcess::Exit;

/// A folder for outputs that is the children's temporary folder and cache too: its name marks the processes of this test.
class RenderTest : public testing::Test {
 protected:
  RenderTest() {
    ::setenv("TMPDIR", folder_.path().c_str(), 1);
    ::setenv("XDG_CACHE_HOME", output("cache").c_str(), 1);
  }
  ~RenderTest() override {
    ::unsetenv("TMPDIR");
    ::unsetenv("XDG_CACHE_HOME");
  }

  ChildProcess start(std::vector<std::string> flags) {
    flags.insert(flags.begin(), "render");
    return std::move(*ChildProcess::start(program("radfarm"), flags, ChildProcess::Stdout::kToStderr));
  }
  Exit run(const std::vector<std::string>& flags) { return start(flags).wait(kPatience).value_or(Exit{true, 0}); }
  std::string output(const std::string& name) const { return (folder_.path() / name).string(); }
  nlohmann::json report(const std::string& name) const {
    return nlohmann::json::parse(read_file(output(name), 1 << 24).value_or("{}"));
  }
  /// Processes that a render started: their data folder lies in ours.
  std::vector<int> farm_processes() const { return processes_with(output("radfarm-render.")); }

  TemporaryDirectory folder_ = *TemporaryDirectory::create("render-test");
};

TEST_F(RenderTest, TheImageDependsOnNeitherWorkersNorThreadsNorTiles) {
  std::string digest;
  for (const char* workers : {"1", "2", "3"}) {
    for (const char* tile : {"8", "17", "64"}) {
      const Exit exit = run({scene("cornell.gltf"), "-o", output("a.exr"), "--report", output("a.json"), "--size",
                             "70x50", "--samples", "4", "--quality", "preview", "--workers", workers, "--threads",
                             workers[0] == '1' ? "2" : "1", "--tile", tile});
      ASSERT_EQ(exit, (Exit{false, 0}));
      const std::string found = report("a.json")["image"]["digest"];
      if (digest.empty()) digest = found;
      EXPECT_EQ(found, digest) << workers << " workers, tiles of " << tile;
    }
  }
}

/// Renders with AOVs.
class AovTest : public RenderTest {
 protected:
  /// The image of a small render with more flags.
  Image rendered(const std::vector<std::string>& more) {
    std::vector<std::string> flags = {scene("cornell.gltf"), "-o", output("a.exr"), "--size", "32x24", "--samples", "4",
                                      "--quality",           "preview", "--no-audit"};
    flags.insert(flags.end(), more.begin(), more.end());
    EXPECT_EQ(run(flags), (Exit{false, 0}));
    const std::string bytes = read_file(output("a.exr"), 1 << 24).value_or("");
    return decode_exr(std::as_bytes(std::span(bytes))).value_or(Image());
  }
};

TEST_F(AovTest, AreLayersThatChangeNoLightWhoeverRenders) {
  for (const char* integrator : {"gather", "path-trace", "radiosity"}) {
    const Image without = rendered({"--integrator", integrator});
    const Image with = rendered({"--integrator", integrator, "--aov", "all", "--workers", "1", "--tile", "9"});
    for (const auto& [name, values] : without.channels) EXPECT_EQ(with.channels.at(name), values) << name;
    EXPECT_GE(with.channels.size(), without.channels.size() + 13) << integrator;
    for (const float samples : with.channels.at("samples.camera")) EXPECT_EQ(samples, 4);
    const Image again = rendered({"--integrator", integrator, "--aov", "all", "--workers", "2", "--tile", "32"});
    EXPECT_EQ(again.channels, with.channels) << integrator;
  }
}

TEST_F(AovTest, ArePicturesOnRequest) {
  rendered({"--aov", "depth,normal", "--aov", "grid", "--aov-png", output("pictures")});
  for (const char* name : {"depth", "normal", "grid"}) {
    EXPECT_EQ(read_file(output("pictures/") + name + ".png", 1 << 24)->substr(1, 3), "PNG");
  }
  EXPECT_FALSE(std::filesystem::exists(output("pictures/albedo.png")));
}

TEST_F(AovTest, WhatCannotBeGivenIsExitCode2) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--aov", "normals"}, {"--aov", "density"}, {"--aov", "grid", "--integrator", "path-trace"}, {"--aov-png", output("x")}};
  for (std::vector<std::string> flags : wrong) {
    flags.insert(flags.begin(), {scene("cornell.gltf"), "-o", output("a.exr")});
    EXPECT_EQ(run(flags), (Exit{false, 2})) << flags.back();
  }
}

TEST_F(RenderTest, ThePapersGatherDependsOnNeitherWorkersNorTiles) {
  std::string digest;
  for (const auto& [workers, tile] : {std::pair("1", "64"), std::pair("2", "8"), std::pair("3", "17")}) {
    const Exit exit = run({scene("cornell.gltf"), "-o", output("a.exr"), "--report", output("a.json"), "--size", "50x40",
                           "--samples", "2", "--quality", "preview", "--gather", "paper", "--workers", workers, "--tile", tile});
    ASSERT_EQ(exit, (Exit{false, 0}));
    const nlohmann::json json = report("a.json");
    EXPECT_EQ(json["settings"]["resolved"]["senders"]["gather"], "paper");
    const std::string found = json["image"]["digest"];
    if (digest.empty()) digest = found;
    EXPECT_EQ(found, digest) << workers << " workers, tiles of " << tile;
  }
}

TEST_F(RenderTest, WritesImagePreviewAndReport) {
  const Exit exit = run({scene("cornell.gltf"), "-o", output("a.exr"), "--png", output("a.png"), "--exposure", "1.5",
                         "--report", output("a.json"), "--size", "32x24", "--quality", "preview"});
  ASSERT_EQ(exit, (Exit{false, 0}));
  EXPECT_EQ(read_file(output("a.exr"), 1 << 24)->substr(0, 4), "\x76\x2f\x31\x01");
  EXPECT_EQ(read_file(output("a.png"), 1 << 24)->substr(1, 3), "PNG");
  const nlohmann::json json = report("a.json");
  EXPECT_EQ(json["image"]["path"], output("a.exr"));
  EXPECT_EQ(json["workers"].size(), 2U);
  EXPECT_TRUE(farm_processes().empty());
}

TEST_F(RenderTest, ASecondRenderUsesTheSolutionOfTheFirst) {
  const auto solution_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> flags = {scene("cornell.gltf"), "-o",        output("a.exr"), "--report",
                                      output("a.json"),      "--quality", "preview",       "--no-audit"};
    flags.insert(flags.end(), more.begin(), more.end());
    EXPECT_EQ(run(flags), (Exit{false, 0}));
    return report("a.json")["solution"];
  };
  const nlohmann::json first = solution_of({"--size", "16x16"}), again = solution_of({"--size", "20x12"});
  EXPECT_EQ(first["reused"], false);
  EXPECT_EQ(again["reused"], true);
  EXPECT_EQ(first["digest"], again["digest"]);
  EXPECT_EQ(solution_of({"--size", "16x16", "--no-cache"})["reused"], false);
  EXPECT_EQ(solution_of({"--size", "16x16", "--seed", "2"})["reused"], false);
}

TEST_F(RenderTest, WithoutAPlaceForItsCacheItRendersAllTheSame) {
  ::setenv("XDG_CACHE_HOME", "/proc/no-such-place", 1);
  for (int n = 0; n < 2; ++n) {
    EXPECT_EQ(run({scene("cornell.gltf"), "-o", output("a.exr"), "--report", output("a.json"), "--size", "16x16",
                   "--quality", "preview", "--no-audit"}),
              (Exit{false, 0}));
    EXPECT_EQ(report("a.json")["solution"]["reused"], false);
  }
}

TEST_F(RenderTest, ABadSceneIsExitCode3AndLeavesNothing) {
  ASSERT_TRUE(
      write_file_atomically(output("bad.gltf"), std::string_view("{\"asset\": {\"version\": \"2.0\"}, \"nodes\": 7}")));
  EXPECT_EQ(run({output("bad.gltf"), "-o", output("a.exr")}), (Exit{false, 3}));
  EXPECT_EQ(run({output("missing.gltf"), "-o", output("a.exr")}), (Exit{false, 3}));
  EXPECT_FALSE(std::filesystem::exists(output("a.exr")));
  EXPECT_TRUE(farm_processes().empty());
}

TEST_F(RenderTest, WrongFlagsAreExitCode2) {
  EXPECT_EQ(run({scene("cornell.gltf")}), (Exit{false, 2}));
  EXPECT_EQ(run({scene("cornell.gltf"), "-o", output("a.exr"), "--error", "0"}), (Exit{false, 2}));
  EXPECT_EQ(run({scene("cornell.gltf"), "-o", output("a.exr"), "--error", "2%", "--no-audit"}), (Exit{false, 2}));
  EXPECT_EQ(run({scene("cornell.gltf"), "-o", output("a.exr"), "--tile", "0"}), (Exit{false, 2}));
}

/// Renders of demonstration scenes, with light and lens from flags.
class AddedLightTest : public RenderTest {
 protected:
  static std::string effect_scene(const std::string& name) { return scene("effects/" + name).string(); }
  /// The report of a small render with more flags; an empty digest where it fails.
  nlohmann::json rendered(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> flags = {effect_scene(name), "-o",        output("a.exr"), "--report", output("a.json"),
                                      "--size",           "32x24",     "--samples",     "4",        "--quality",
                                      "preview",          "--no-audit"};
    flags.insert(flags.end(), more.begin(), more.end());
    EXPECT_EQ(run(flags), (Exit{false, 0}));
    return report("a.json");
  }
  std::string digest(const std::string& name, const std::vector<std::string>& more) {
    return rendered(name, more)["image"]["digest"];
  }
  /// 2 x 1 pixels of one grey, RGBE without runs.
  std::string write_map(const std::string& name, unsigned char mantissa) {
    const std::string m(1, static_cast<char>(mantissa)), pixel = m + m + m + "\x88";
    EXPECT_TRUE(write_file_atomically(output(name), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + pixel + pixel));
    return output(name);
  }
  /// What radfarm prints, and how it ends.
  std::pair<std::string, Exit> printed(const std::vector<std::string>& flags) const {
    ChildProcess child = std::move(*ChildProcess::start(program("radfarm"), flags, ChildProcess::Stdout::kCapture));
    std::string text;
    while (const Result<std::string> line = child.read_line(kPatience)) text += *line + "\n";
    return {text, child.wait(kPatience).value_or(Exit{true, 0})};
  }
};

TEST_F(AddedLightTest, ASkyThroughPanesGivesTheSameImageForAnyWorkersAndTiles) {
  std::string first;
  for (const char* workers : {"1", "2"}) {
    for (const char* tile : {"8", "17"}) {
      const std::string found =
          digest("window.gltf", {"--env", "sky:overcast,lux=50", "--workers", workers, "--tile", tile});
      if (first.empty()) first = found;
      EXPECT_EQ(found, first) << workers << " workers, tiles of " << tile;
    }
  }
  EXPECT_FALSE(first.empty());
}

TEST_F(AddedLightTest, AMapIsSentAlongAndUsed) {
  const std::string dim = digest("open_plane_sky.gltf", {"--env", write_map("sky.hdr", 0x40)});
  const std::string bright = digest("open_plane_sky.gltf", {"--env", write_map("other.hdr", 0x80)});
  EXPECT_NE(dim, bright);
  // Another file of the same contents is the same light.
  EXPECT_EQ(digest("open_plane_sky.gltf", {"--env", write_map("copy.hdr", 0x80)}), bright);
}

TEST_F(AddedLightTest, APhotometryIsSentAlongAndUsed) {
  const std::string even = digest("ies_lamp.gltf", {});
  EXPECT_NE(digest("ies_lamp.gltf", {"--ies", "downlight=" + effect_scene("downlight.ies")}), even);
}

TEST_F(AddedLightTest, ALensBlurs) {
  const std::string sharp = digest("depth_of_field.gltf", {});
  const std::string blurred = digest("depth_of_field.gltf", {"--lens-diameter", "0.3", "--focus-distance", "3"});
  EXPECT_NE(blurred, sharp);
  EXPECT_NE(digest("depth_of_field.gltf", {"--lens-diameter", "0.3", "--focus-distance", "1"}), blurred);
  EXPECT_EQ(digest("depth_of_field.gltf", {"--lens-diameter", "0", "--focus-distance", "3"}), sharp);
}

TEST_F(AddedLightTest, WhatIsWrongWithAFileIsExitCode3) {
  const auto exit_of = [&](const std::string& flag, const std::string& value) {
    return run({effect_scene("ies_lamp.gltf"), "-o", output("a.exr"), flag, value});
  };
  EXPECT_EQ(exit_of("--env", output("missing.hdr")), (Exit{false, 3}));
  EXPECT_EQ(exit_of("--ies", "no such light=" + effect_scene("downlight.ies")), (Exit{false, 3}));
  EXPECT_EQ(exit_of("--env", effect_scene("downlight.ies")), (Exit{false, 3}));
  EXPECT_EQ(exit_of("--env", "sky:weather=fine"), (Exit{false, 3}));
  EXPECT_EQ(exit_of("--ies", "downlight"), (Exit{false, 2}));
  EXPECT_FALSE(std::filesystem::exists(output("a.exr")));
}

TEST_F(AddedLightTest, ExplainPrintsTheTableOfEffects) {
  const auto [text, exit] = printed({"explain", effect_scene("window.gltf"), "--env", "sky:overcast,lux=50"});
  EXPECT_EQ(exit, (Exit{false, 0}));
  for (const char* id : {"panes", "environment", "interreflection", "depth_of_field", "caustics", "gloss", "bounces"}) {
    EXPECT_NE(text.find(id), std::string::npos) << id << " in\n" << text;
  }
}

class EndedRenderTest : public RenderTest {
 protected:
  /// A render whose radiosity takes long, once it says that it is in `phase`.
  ChildProcess start_until(const std::string& phase) {
    const std::string program = test::program("radfarm").string();
    ChildProcess render = std::move(*ChildProcess::start(
        "/bin/sh",
        {"-c", "exec \"$0\" \"$@\" 2>&1", program, "render", write_boxes(), "-o", output("a.exr"), "--quality", "reference"},
        ChildProcess::Stdout::kCapture));
    bool is_there = false;
    while (!is_there) {
      const Result<std::string> line = render.read_line(kPatience);
      if (!line) break;
      is_there = line->find(phase) != std::string::npos;
    }
    EXPECT_TRUE(is_there) << phase;
    return render;
  }
  /// A lit room of a few thousand boxes, each of which every other may see.
  std::string write_boxes() const {
    std::string text = "mtllib boxes.mtl\nusemtl grey\n";
    int vertices = 0;
    const auto box = [&](double x, double y, double z, double size) {
      for (int i = 0; i < 8; ++i) {
        text += "v " + std::to_string(x + (i & 1) * size) + " " + std::to_string(y + (i >> 1 & 1) * size) + " " +
                std::to_string(z + (i >> 2) * size) + "\n";
      }
      for (const auto& f : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"}) {
        text += "f";
        for (const char* at = f; *at != 0; at += 2) {
          text += " " + std::to_string(vertices + (*at - '0'));
          if (at[1] == 0) break;
        }
        text += "\n";
      }
      vertices += 8;
    };
    for (int i = 0; i < 4096; ++i) box(i % 16, i / 16 % 16, i / 256, 0.5);
    box(-1, -1, -1, 19);
    text += "usemtl lamp\n";
    box(7.6, 17, 7.6, 0.8);
    EXPECT_TRUE(write_file_atomically(output("boxes.obj"), text));
    EXPECT_TRUE(write_file_atomically(output("boxes.mtl"),
                                      std::string_view("newmtl grey\nKd .7 .7 .7\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n")));
    return output("boxes.obj");
  }
  /// A render that would take minutes, once its workers and a prepared scene are there.
  ChildProcess start_long_render() {
    ChildProcess render = start({scene("cornell.gltf"), "-o", output("a.exr"), "--size", "1000x1000", "--samples",
                                 "4096", "--integrator", "path-trace"});
    EXPECT_TRUE(eventually([&] { return has_fetched_a_view(); })) << "a worker is at work";
    EXPECT_GE(farm_processes().size(), 3U);
    return render;
  }
  /// Blobs lie in the workers' cache.
  bool has_fetched_a_view() const {
    int files = 0;
    std::error_code ignored;  // the folders come and go
    for (const auto& render : std::filesystem::directory_iterator(folder_.path(), ignored)) {
      const std::filesystem::recursive_directory_iterator cache(render.path() / "cache", ignored);
      for (const auto& entry : cache) files += entry.path().filename().string().size() == 64 ? 1 : 0;
    }
    return files >= 2;
  }
};

TEST_F(EndedRenderTest, CtrlCCancelsAndLeavesNothing) {
  ChildProcess render = start_long_render();
  render.signal(SIGINT);
  EXPECT_EQ(render.wait(kPatience), (Exit{false, 4}));
  EXPECT_TRUE(farm_processes().empty());
  EXPECT_FALSE(std::filesystem::exists(output("a.exr")));
}

TEST_F(EndedRenderTest, CtrlCInTheMiddleOfThePreparationEndsAllWithinASecond) {
  // Phases that last: one that is over at once may never be shown.
  for (const char* phase : {"preparing", "radiosity: links"}) {
    ChildProcess render = start_until(phase);
    const auto asked = std::chrono::steady_clock::now();
    render.signal(SIGINT);
    EXPECT_EQ(render.wait(kPatience), (Exit{false, 4})) << phase;
    EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(1)) << phase;
    EXPECT_TRUE(farm_processes().empty()) << phase;
    EXPECT_FALSE(std::filesystem::exists(output("a.exr")));
  }
}

TEST_F(EndedRenderTest, AKilledRenderTakesItsFarmAlong) {
  ChildProcess render = start_long_render();
  render.signal(SIGKILL);
  EXPECT_EQ(render.wait(kPatience), (Exit{true, SIGKILL}));
  EXPECT_TRUE(eventually([&] { return farm_processes().empty(); }));
}

TEST_F(EndedRenderTest, WhenAllWorkersDieItSaysSoAndEnds) {
  ChildProcess render = start_long_render();
  for (const int pid : processes_with("--coordinator")) {
    const std::vector<int> ours = farm_processes();
    if (std::find(ours.begin(), ours.end(), pid) != ours.end()) ::kill(pid, SIGKILL);
  }
  EXPECT_EQ(render.wait(kPatience), (Exit{false, 1}));
  EXPECT_TRUE(farm_processes().empty());
}

}  // namespace
}  // namespace radfarm::test
