// `radfarm render` with a target instead of a quality.
#include <cstdlib>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "integration/processes.h"
#include "process/child_process.h"

namespace radfarm::test {
namespace {

using Exit = ChildProcess::Exit;

class TargetsTest : public testing::Test {
 protected:
  TargetsTest() { ::setenv("XDG_CACHE_HOME", output("cache").c_str(), 1); }
  ~TargetsTest() override { ::unsetenv("XDG_CACHE_HOME"); }

  Exit run(std::vector<std::string> flags) const {
    flags.insert(flags.begin(), "render");
    ChildProcess child = std::move(*ChildProcess::start(program("radfarm"), flags, ChildProcess::Stdout::kToStderr));
    return child.wait(kPatience).value_or(Exit{true, 0});
  }
  std::string output(const std::string& name) const { return (folder_.path() / name).string(); }
  nlohmann::json report(const std::string& name) const {
    return nlohmann::json::parse(read_file(output(name), 1 << 24).value_or("{}"));
  }

  TemporaryDirectory folder_ = *TemporaryDirectory::create("targets-test");
};

TEST_F(TargetsTest, AnErrorThatIsAskedForIsMetAndExitCode0) {
  const std::vector<std::string> flags = {scene("cornell.gltf"), "-o",     output("a.exr"), "--report", output("a.json"),
                                          "--size",              "48x36",  "--error",       "10%",      "--workers"};
  std::string digest;
  for (const char* workers : {"1", "3"}) {
    std::vector<std::string> all = flags;
    all.emplace_back(workers);
    ASSERT_EQ(run(all), (Exit{false, 0}));
    const nlohmann::json json = report("a.json");
    EXPECT_EQ(json["accuracy"]["target"], 0.1);
    EXPECT_EQ(json["accuracy"]["target_met"], true);
    EXPECT_LT(json["accuracy"]["relative_rmse_ci95"][1], 0.1);
    EXPECT_GE(json["rounds"].size(), 1U);
    EXPECT_GT(json["accuracy"]["audit_cpu_share"], 0);
    if (digest.empty()) digest = json["image"]["digest"];
    EXPECT_EQ(json["image"]["digest"], digest) << "no clock decides";
  }
}

TEST_F(TargetsTest, AnErrorThatCannotBeReachedIsExitCode5WithItsImage) {
  EXPECT_EQ(run({scene("cornell.gltf"), "-o", output("a.exr"), "--report", output("a.json"), "--size", "16x12", "--integrator",
                 "radiosity", "--error", "0.1%"}),
            (Exit{false, 5}));
  EXPECT_EQ(read_file(output("a.exr"), 1 << 24)->substr(0, 4), "\x76\x2f\x31\x01");
  const nlohmann::json json = report("a.json");
  EXPECT_EQ(json["accuracy"]["target_met"], false);
  EXPECT_GE(json["rounds"].size(), 2U);
  EXPECT_LE(json["rounds"].size(), 4U);
}

TEST_F(TargetsTest, ATargetOfSecondsSaysWhatItTook) {
  EXPECT_EQ(run({scene("cornell.gltf"), "-o", output("a.exr"), "--report", output("a.json"), "--size", "48x36", "--time", "6"}),
            (Exit{false, 0}));
  const nlohmann::json json = report("a.json");
  EXPECT_EQ(json["time"]["target_s"], 6.0);
  EXPECT_GT(json["time"]["elapsed_s"], 0);
  EXPECT_TRUE(json["accuracy"]["target_met"].is_null());
  EXPECT_GT(json["accuracy"]["audited_pixels"], 0);
  EXPECT_NE(json["warnings"].dump().find("--time"), std::string::npos);
}

}  // namespace
}  // namespace radfarm::test
