#include "frame/aovs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace radfarm {
namespace {

using Integrator = RenderRequest::Integrator;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

RenderRequest request_of(Integrator integrator, std::vector<std::string> aov) {
  RenderRequest request;
  request.integrator = integrator;
  request.aov = std::move(aov);
  return request;
}

std::vector<std::string> all_of(Integrator integrator) {
  return aov_names(requested_aovs(request_of(integrator, {"all"})).value());
}

TEST(RequestedAovs, AreThoseNamed) {
  EXPECT_EQ(requested_aovs(RenderRequest()).value(), 0U);
  const AovSet set = requested_aovs(request_of(Integrator::kAuto, {"depth", "samples.camera", "depth"})).value();
  EXPECT_EQ(set, set_of(Aov::kDepth) | set_of(Aov::kCameraSamples));
  EXPECT_EQ(aov_names(set), (std::vector<std::string>{"depth", "samples.camera"}));
}

TEST(RequestedAovs, AllIsWhatTheIntegratorGives) {
  for (const Integrator gathers : {Integrator::kAuto, Integrator::kGather, Integrator::kFullGather}) {
    EXPECT_EQ(all_of(gathers).size(), kAovCount);
  }
  for (const Integrator other : {Integrator::kPathTrace, Integrator::kRadiosity}) {
    EXPECT_THAT(all_of(other), Contains("irradiance"));
    for (const char* name : {"grid", "classification", "samples.formfactor"}) {
      EXPECT_THAT(all_of(other), Not(Contains(name)));
      const Error error = requested_aovs(request_of(other, {name})).error();
      EXPECT_EQ(error.code, Code::kInvalidArgument);
      EXPECT_THAT(error.message, HasSubstr("--integrator " + to_string(other) + " does not give it"));
    }
  }
}

TEST(RequestedAovs, OneSampleHasNoVariance) {
  RenderRequest request = request_of(Integrator::kGather, {"all"});
  request.samples = 1;
  EXPECT_THAT(aov_names(requested_aovs(request).value()), Not(Contains("variance")));
  request.aov = {"variance"};
  EXPECT_THAT(requested_aovs(request).error().message, HasSubstr("--samples"));
}

TEST(RequestedAovs, LightGroupsAreNoAovAndNotAmongAll) {
  for (const Integrator integrator : {Integrator::kAuto, Integrator::kPathTrace, Integrator::kRadiosity}) {
    const RenderRequest request = request_of(integrator, {"light", "depth"});
    EXPECT_EQ(requested_aovs(request).value(), set_of(Aov::kDepth));
    EXPECT_TRUE(wants_light_groups(request));
    EXPECT_FALSE(wants_light_groups(request_of(integrator, {"all"})));
  }
  RenderRequest request = request_of(Integrator::kAuto, {"light"});
  request.gather = Gather::kPaper;
  EXPECT_TRUE(requested_aovs(request)) << "the paper's gather gives no AOV, but light groups";
  request = request_of(Integrator::kRadiosity, {"light"});
  request.mesh = true;
  EXPECT_THAT(validate(request).error().message, HasSubstr("--mesh"));
}

TEST(RequestedAovs, UnknownNamesAreAnsweredWithTheKnownOnes) {
  for (const char* name : {"normals", "", "ALL"}) {
    const Error error = validate(request_of(Integrator::kAuto, {"depth", name})).error();
    EXPECT_EQ(error.code, Code::kInvalidArgument);
    EXPECT_THAT(error.message, HasSubstr("all, albedo, normal, depth"));
    EXPECT_THAT(error.message, HasSubstr("grid"));
  }
}

TEST(RequestedAovs, WhatIsNotBuiltSaysSo) {
  for (const char* name : {"density"}) {
    const Error error = requested_aovs(request_of(Integrator::kAuto, {name})).error();
    EXPECT_EQ(error.code, Code::kUnimplemented);
    EXPECT_THAT(error.message, HasSubstr("is not built yet: "));
  }
}

}  // namespace
}  // namespace radfarm
