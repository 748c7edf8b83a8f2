#include "cli/request_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace radfarm::cli {
namespace {

using testing::HasSubstr;

Result<RenderRequest> parse(const std::string& line) {
  CLI::App app;
  RequestFlags flags;
  add_request_flags(app, flags);
  app.parse(line);
  return parse_request(flags);
}

std::string error_of(const std::string& line) {
  const Result<RenderRequest> request = parse(line);
  return request ? "accepted" : request.error().message;
}

TEST(RequestFlags, DefaultsAreTheRequestsDefaults) { EXPECT_EQ(*parse(""), RenderRequest()); }

TEST(RequestFlags, FillTheRequest) {
  const RenderRequest request = *parse(
      "--size 70x50 --samples 4 --seed 9 --tile 17 --integrator path-trace --quality high --no-audit "
      "--threshold 0.5 --link-error 0.001 --up Z --camera 1 --oracle HE");
  EXPECT_EQ(request.width, 70);
  EXPECT_EQ(request.height, 50);
  EXPECT_EQ(request.samples, 4);
  EXPECT_EQ(request.seed, 9U);
  EXPECT_EQ(request.tile, 17);
  EXPECT_EQ(request.integrator, RenderRequest::Integrator::kPathTrace);
  EXPECT_EQ(request.quality, RenderRequest::Quality::kHigh);
  EXPECT_FALSE(request.audit);
  EXPECT_EQ(request.threshold, 0.5F);
  EXPECT_EQ(request.link_error, 0.001F);
  EXPECT_EQ(request.oracle, Oracle::kHe);
  EXPECT_EQ(request.up, RenderRequest::UpAxis::kZ);
  EXPECT_EQ(std::get<RenderRequest::NamedCamera>(request.camera).name_or_index, "1");
}

TEST(RequestFlags, AddLightAndALens) {
  const RenderRequest request = *parse(
      "--env sky:overcast,lux=50 --ies desk=a/b.ies --ies ceiling=c=d.ies --lens-diameter 0.02 --focus-distance 3");
  EXPECT_EQ(request.env, "sky:overcast,lux=50");
  EXPECT_EQ(request.ies, (std::map<std::string, std::string>{{"desk", "a/b.ies"}, {"ceiling", "c=d.ies"}}));
  EXPECT_EQ(request.lens_diameter, 0.02F);
  EXPECT_EQ(request.focus_distance, 3);
  EXPECT_THAT(error_of("--ies desk"), HasSubstr("NAME=FILE"));
  EXPECT_THAT(error_of("--ies =a.ies"), HasSubstr("NAME=FILE"));
  EXPECT_THAT(error_of("--ies desk="), HasSubstr("NAME=FILE"));
  EXPECT_THAT(error_of("--ies desk=a.ies --ies desk=b.ies"), HasSubstr("has a file already"));
  EXPECT_THAT(error_of("--lens-diameter -1"), HasSubstr("--lens-diameter"));
  EXPECT_THAT(error_of("--focus-distance 0"), HasSubstr("--focus-distance"));
}

TEST(RequestFlags, FilesAreCalledByNumberInTheJobAndByTheirWholePathHere) {
  RenderRequest in_job = *parse("--env maps/sky.hdr --ies b=lamp.ies --ies a=other/lamp.ies"), here = in_job;
  const std::vector<Attachment> attached = attach_files(in_job);
  ASSERT_EQ(attached.size(), 3U);
  EXPECT_EQ(in_job.env, "attached-0-sky.hdr");
  EXPECT_EQ(attached[0].local, "maps/sky.hdr");
  EXPECT_NE(in_job.ies["a"], in_job.ies["b"]) << "two files of one name";
  for (const Attachment& file : attached) EXPECT_EQ(file.in_job.find('/'), std::string::npos);
  locate_files(here);
  EXPECT_EQ(here.env, std::filesystem::absolute("maps/sky.hdr"));
  RenderRequest sky = *parse("--env sky:overcast");
  EXPECT_TRUE(attach_files(sky).empty());
  locate_files(sky);
  EXPECT_EQ(sky.env, "sky:overcast");
}

TEST(RequestFlags, PlaceACamera) {
  const RenderRequest request = *parse("--eye 1,2.5,-3 --look-at 0,0,0 --fov 30");
  const auto& camera = std::get<RenderRequest::PlacedCamera>(request.camera);
  EXPECT_EQ(camera.eye, Vec3d(1, 2.5, -3));
  EXPECT_EQ(camera.vertical_fov_degrees, 30);
}

TEST(RequestFlags, WrongValuesAreNamedWithWhatWouldBeRight) {
  EXPECT_THAT(error_of("--size 640"), HasSubstr("WIDTHxHEIGHT"));
  EXPECT_THAT(error_of("--size 640x"), HasSubstr("WIDTHxHEIGHT"));
  EXPECT_THAT(error_of("--size 0x5"), HasSubstr("--size"));
  EXPECT_THAT(error_of("--eye 1,2 --look-at 0,0,0"), HasSubstr("three numbers"));
  EXPECT_THAT(error_of("--eye 1,2,nan --look-at 0,0,0"), HasSubstr("three numbers"));
  EXPECT_THAT(error_of("--eye 1,2,3"), HasSubstr("--look-at"));
  EXPECT_THAT(error_of("--eye 1,2,3 --look-at 0,0,0 --camera x"), HasSubstr("exclude"));
  EXPECT_THAT(error_of("--up X"), HasSubstr("Y or Z"));
  EXPECT_THAT(error_of("--integrator magic"), HasSubstr("path-trace"));
  EXPECT_THAT(error_of("--quality best"), HasSubstr("standard"));
  EXPECT_THAT(error_of("--oracle MI"), HasSubstr("KS, KL, CS, HE, VAR"));
  EXPECT_THAT(error_of("--samples 0"), HasSubstr("--samples"));
}

TEST(RequestFlags, TheMeshIsDrawnOverTheRadiositySolutionAlone) {
  EXPECT_TRUE(parse("--integrator radiosity --mesh")->mesh);
  EXPECT_FALSE(parse("--integrator radiosity")->mesh);
  EXPECT_THAT(error_of("--mesh"), HasSubstr("--integrator radiosity"));
  EXPECT_THAT(error_of("--mesh --integrator gather"), HasSubstr("--integrator radiosity"));
}

TEST(RequestFlags, AovsAreAListAndTakeNoMoreThanOneWord) {
  EXPECT_EQ(parse("--aov depth,samples.camera --aov all")->aov, (std::vector<std::string>{"depth", "samples.camera", "all"}));
  CLI::App app;
  RequestFlags flags;
  std::string scene;
  app.add_option("SCENE", scene);
  add_request_flags(app, flags);
  app.parse("--aov depth,normal room.gltf");
  EXPECT_EQ(scene, "room.gltf");
  EXPECT_THAT(error_of("--aov normals"), HasSubstr("albedo, normal"));
  EXPECT_THAT(error_of("--aov grid --integrator path-trace"), HasSubstr("does not give it"));
}

TEST(RequestFlags, TheGatherIsOursOrThePapers) {
  EXPECT_EQ(parse("")->gather, Gather::kDefault);
  EXPECT_EQ(parse("--gather paper")->gather, Gather::kPaper);
  EXPECT_THAT(error_of("--gather grid"), HasSubstr("--gather"));
  EXPECT_THAT(error_of("--gather paper --integrator path-trace"), HasSubstr("--gather paper"));
}

TEST(RequestFlags, PhotonsAndRadiusAreOfPathsAndGathers) {
  const Result<RenderRequest> request = parse("--integrator paths --photons 5000 --radius .1");
  ASSERT_TRUE(request) << request.error().message;
  EXPECT_EQ(request->photons, 5000U);
  EXPECT_EQ(request->radius, .1F);
  EXPECT_EQ(parse("--integrator gather --radius 1")->radius, 1.0F);  // where the plan finds caustics
  EXPECT_THAT(error_of("--integrator path-trace --photons 5"), HasSubstr("--integrator auto, gather"));
  EXPECT_THAT(error_of("--integrator radiosity --radius 1"), HasSubstr("--integrator auto, gather"));
  EXPECT_EQ(parse("--integrator photon-map --photons 5000")->integrator, RenderRequest::Integrator::kPhotonMap);
  EXPECT_THAT(error_of("--integrator paths --photons 0"), HasSubstr("--photons is 0"));
  EXPECT_THAT(error_of("--integrator paths --radius 0"), HasSubstr("--radius"));
}

TEST(RequestFlags, ATargetStandsInsteadOfAQuality) {
  EXPECT_DOUBLE_EQ(*parse("--error 2%")->error, 0.02);
  EXPECT_DOUBLE_EQ(*parse("--error .02")->error, 0.02);
  EXPECT_DOUBLE_EQ(*parse("--error 100%")->error, 1);
  EXPECT_DOUBLE_EQ(*parse("--time 90")->time, 90);
  EXPECT_DOUBLE_EQ(*parse("--time 60s")->time, 60);
  EXPECT_DOUBLE_EQ(*parse("--time 2m")->time, 120);
  EXPECT_DOUBLE_EQ(*parse("--time 1.5h")->time, 5400);
  for (const char* line : {"--error 2% --quality high", "--time 60 --quality standard", "--error 2% --time 60"}) {
    EXPECT_THAT(error_of(line), HasSubstr("exclude each other")) << line;
  }
  for (const char* line : {"--error 0", "--error=-2%", "--error 101%", "--error 2", "--error x", "--error nan",
                           "--error 1e-9", "--error %"}) {
    EXPECT_THAT(error_of(line), HasSubstr("--error: '")) << line;
  }
  for (const char* line : {"--time 0", "--time=-5", "--time x", "--time inf", "--time s", "--time 5d"}) {
    EXPECT_THAT(error_of(line), HasSubstr("--time: '")) << line;
  }
  EXPECT_THAT(error_of("--time .5"), HasSubstr("from 1 s"));
  EXPECT_THAT(error_of("--error 2% --no-audit"), HasSubstr("--no-audit"));
  EXPECT_THAT(error_of("--time 9 --no-audit"), HasSubstr("--no-audit"));
  EXPECT_THAT(error_of("--error 2% --mesh --integrator radiosity"), HasSubstr("--mesh"));
}

TEST(RequestFlags, WhatIsNotBuiltIsRefusedAndNotIgnored) {
  for (const char* line : {"--aov density", "--criterion KL"}) {
    const Result<RenderRequest> request = parse(line);
    ASSERT_FALSE(request) << line;
    EXPECT_EQ(request.error().code, Code::kUnimplemented) << line;
    EXPECT_THAT(request.error().message, HasSubstr("is not built yet: ")) << line;
  }
}

}  // namespace
}  // namespace radfarm::cli
