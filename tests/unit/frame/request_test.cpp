#include "frame/request.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace radfarm {
namespace {

using Json = nlohmann::json;

RenderRequest unusual_request() {
  RenderRequest request;
  request.integrator = RenderRequest::Integrator::kRadiosity;
  request.quality = RenderRequest::Quality::kReference;
  request.camera = RenderRequest::PlacedCamera{{0.1, 2, 3}, {4, 5, 1e-17}, {0, 0, 1}, 33.3, 2.5};
  request.width = 320;
  request.height = 200;
  request.up = RenderRequest::UpAxis::kZ;
  request.seed = 18446744073709551615U;
  request.tile = 7;
  request.samples = 3;
  request.link_error = 1e-3F;
  request.threshold = 0.1F;
  request.oracle = Oracle::kVar;
  request.audit = false;
  request.mesh = true;
  request.env = "maps/sky.hdr";
  request.ies = {{"desk", "a.ies"}, {"ceiling", "b.ies"}};
  request.lens_diameter = 0.02F;
  request.focus_distance = 3;
  request.aov = {"depth", "samples.camera"};
  request.effects = std::string("+textures,-masking");
  return request;
}

std::string message_of(const std::string& text) {
  const Result<RenderRequest> request = render_request_from_json(Json::parse(text));
  if (request) return "no error";
  EXPECT_EQ(request.error().code, Code::kInvalidArgument);
  return request.error().message;
}

TEST(RenderRequest, ThePapersGatherIsAWayToGather) {
  RenderRequest request;
  request.gather = Gather::kPaper;
  EXPECT_TRUE(validate(request));
  EXPECT_EQ(*render_request_from_json(to_json(request)), request);
  for (const auto other : {RenderRequest::Integrator::kPathTrace, RenderRequest::Integrator::kRadiosity}) {
    request.integrator = other;
    ASSERT_FALSE(validate(request));
    EXPECT_EQ(validate(request).error().code, Code::kInvalidArgument);
  }
  EXPECT_THAT(message_of(R"({"gather": "grid"})"), testing::HasSubstr("default, paper"));
}

TEST(RenderRequest, JsonRoundTripKeepsEverything) {
  for (const RenderRequest& request : {RenderRequest(), unusual_request()}) {
    const std::string text = to_json(request).dump();
    EXPECT_EQ(render_request_from_json(Json::parse(text)).value(), request) << text;
    EXPECT_EQ(render_request_from_json(to_json(request)).value(), request) << text;
  }
}

TEST(RenderRequest, MissingKeysTakeTheirDefaults) {
  EXPECT_EQ(render_request_from_json(Json::object()).value(), RenderRequest());
  EXPECT_EQ(render_request_from_json(Json::parse(R"({"camera": {}})")).value(), RenderRequest());
  const RenderRequest placed =
      render_request_from_json(Json::parse(R"({"camera": {"eye": [1, 2, 3], "look_at": [0, 0, 0]}})")).value();
  EXPECT_EQ(std::get<RenderRequest::PlacedCamera>(placed.camera).vertical_fov_degrees, 45);
}

TEST(RenderRequest, UnknownKeysAreNamed) {
  EXPECT_THAT(message_of(R"({"sample": 3})"), testing::HasSubstr("'sample'"));
  EXPECT_THAT(message_of(R"({"camera": {"fov": 3}})"), testing::HasSubstr("camera.fov"));
}

TEST(RenderRequest, WrongTypesNameTheKeyAndWhatWouldBeRight) {
  EXPECT_THAT(message_of("[]"), testing::HasSubstr("object"));
  EXPECT_THAT(message_of(R"({"width": "640"})"), testing::HasSubstr("width: must be a whole number"));
  EXPECT_THAT(message_of(R"({"width": 640.5})"), testing::HasSubstr("width"));
  EXPECT_THAT(message_of(R"({"width": 99999999999})"), testing::HasSubstr("width"));
  EXPECT_THAT(message_of(R"({"width": null})"), testing::HasSubstr("width"));
  EXPECT_THAT(message_of(R"({"seed": -1})"), testing::HasSubstr("seed"));
  EXPECT_THAT(message_of(R"({"audit": 1})"), testing::HasSubstr("audit: must be true or false"));
  EXPECT_THAT(message_of(R"({"threshold": 1e300})"), testing::HasSubstr("threshold"));
  EXPECT_THAT(message_of(R"({"ies": ["lamp.ies"]})"), testing::HasSubstr("ies: must be an object"));
  EXPECT_THAT(message_of(R"({"ies": {"desk": 7}})"), testing::HasSubstr("ies.desk"));
  EXPECT_THAT(message_of(R"({"aov": "depth"})"), testing::HasSubstr("aov: must be an array"));
  EXPECT_THAT(message_of(R"({"aov": [7]})"), testing::HasSubstr("aov"));
  EXPECT_THAT(message_of(R"({"env": 7})"), testing::HasSubstr("env"));
  EXPECT_THAT(message_of(R"({"lens_diameter": "wide"})"), testing::HasSubstr("lens_diameter"));
  EXPECT_THAT(message_of(R"({"camera": "main"})"), testing::HasSubstr("camera"));
  EXPECT_THAT(message_of(R"({"camera": {"eye": [1, 2], "look_at": [0, 0, 0]}})"), testing::HasSubstr("camera.eye"));
  EXPECT_THAT(message_of(R"({"camera": {"eye": [1, 2, 3]}})"), testing::HasSubstr("look_at"));
  EXPECT_THAT(message_of(R"({"camera": {"name": "a", "eye": [1, 2, 3]}})"), testing::HasSubstr("one of them"));
  EXPECT_THAT(message_of(R"({"integrator": "magic"})"), testing::HasSubstr("path-trace"));
  EXPECT_THAT(message_of(R"({"quality": "best"})"), testing::HasSubstr("reference"));
  EXPECT_THAT(message_of(R"({"up": "X"})"), testing::HasSubstr("Y, Z"));
}

TEST(RenderRequest, NamesRoundTrip) {
  for (const char* name : {"auto", "gather", "full-gather", "path-trace"}) {
    EXPECT_EQ(to_string(integrator_from_string(name).value()), name);
  }
  for (const char* name : {"preview", "standard", "high", "reference"}) {
    EXPECT_EQ(to_string(quality_from_string(name).value()), name);
  }
}

TEST(RenderRequest, DefaultsAndUnusualValuesAreValid) {
  EXPECT_TRUE(validate(RenderRequest()));
  EXPECT_TRUE(validate(unusual_request()));
}

struct Invalid {
  const char* flag;
  void (*change)(RenderRequest& request);
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

RenderRequest::PlacedCamera placed(const Vec3d& eye, const Vec3d& look_at, const Vec3d& up = {0, 1, 0}, double fov = 45,
                                   std::optional<double> orthographic_height = {}) {
  return {eye, look_at, up, fov, orthographic_height};
}

TEST(RenderRequest, ValuesOutOfRangeNameTheirFlag) {
  const std::vector<Invalid> cases = {
      {"--size", [](RenderRequest& r) { r.width = 0; }},
      {"--size", [](RenderRequest& r) { r.height = 16385; }},
      {"--tile", [](RenderRequest& r) { r.tile = 0; }},
      {"--samples", [](RenderRequest& r) { r.samples = -1; }},
      {"--link-error", [](RenderRequest& r) { r.link_error = 0.0F; }},
      {"--link-error", [](RenderRequest& r) { r.link_error = std::numeric_limits<float>::quiet_NaN(); }},
      {"--threshold", [](RenderRequest& r) { r.threshold = 0.0F; }},
      {"--threshold", [](RenderRequest& r) { r.threshold = std::numeric_limits<float>::quiet_NaN(); }},
      {"--eye", [](RenderRequest& r) { r.camera = placed({kNan, 0, 0}, {1, 0, 0}); }},
      {"--look-at", [](RenderRequest& r) { r.camera = placed({1, 0, 0}, {1, 0, 0}); }},
      {"--up-vector", [](RenderRequest& r) { r.camera = placed({0, 0, 0}, {0, 2, 0}); }},
      {"--up-vector", [](RenderRequest& r) { r.camera = placed({0, 0, 0}, {1, 0, 0}, {0, 0, 0}); }},
      {"--fov", [](RenderRequest& r) { r.camera = placed({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 180); }},
      {"--fov", [](RenderRequest& r) { r.camera = placed({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, kNan); }},
      {"--orthographic", [](RenderRequest& r) { r.camera = placed({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 45, 0); }},
      {"--orthographic", [](RenderRequest& r) { r.camera = placed({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 45, kNan); }},
      {"--lens-diameter", [](RenderRequest& r) { r.lens_diameter = -1.0F; }},
      {"--lens-diameter", [](RenderRequest& r) { r.lens_diameter = std::numeric_limits<float>::quiet_NaN(); }},
      {"--focus-distance", [](RenderRequest& r) { r.focus_distance = 0.0F; }},
      {"--focus-distance", [](RenderRequest& r) { r.focus_distance = std::numeric_limits<float>::infinity(); }},
      {"--env", [](RenderRequest& r) { r.env = std::string(5000, 'x'); }},
      {"--ies", [](RenderRequest& r) {
         for (int i = 0; i < 1001; ++i) r.ies[std::to_string(i)] = "lamp.ies";
       }},
      {"--camera", [](RenderRequest& r) { r.camera = RenderRequest::NamedCamera{std::string(5000, 'x')}; }},
      {"--effects", [](RenderRequest& r) { r.effects = std::string("textures"); }},
      {"--effects", [](RenderRequest& r) { r.effects = std::string("+"); }},
      {"--effects", [](RenderRequest& r) { r.effects = std::string("+a,"); }},
      {"--effects", [](RenderRequest& r) { r.effects = std::string("+a,,-b"); }},
      {"--effects", [](RenderRequest& r) { r.effects = std::string("+a\n"); }},
  };
  for (const Invalid& invalid : cases) {
    RenderRequest request;
    invalid.change(request);
    const Status status = validate(request);
    ASSERT_FALSE(status) << invalid.flag << " " << request.effects;
    EXPECT_EQ(status.error().code, Code::kInvalidArgument);
    EXPECT_THAT(status.error().message, testing::StartsWith(invalid.flag));
  }
}

TEST(RenderRequestTarget, StandsInsteadOfAQualityAndComesBack) {
  RenderRequest error, time;
  error.error = 0.02;
  time.time = 90;
  for (const RenderRequest& request : {error, time}) {
    const nlohmann::json json = to_json(request);
    EXPECT_FALSE(json.contains("quality"));
    EXPECT_EQ(*render_request_from_json(json), request);
    EXPECT_TRUE(validate(request));
  }
  for (const char* text : {R"({"error": 0.02, "time": 9})", R"({"error": 0.02, "quality": "high"})",
                           R"({"time": 9, "quality": "standard"})"}) {
    EXPECT_EQ(render_request_from_json(nlohmann::json::parse(text)).error().code, Code::kInvalidArgument) << text;
  }
  for (const char* text : {R"({"error": 0})", R"({"error": -1})", R"({"error": 1.5})", R"({"time": 0})", R"({"time": 1e30})",
                           R"({"error": 0.02, "audit": false})", R"({"error": 0.02, "integrator": "radiosity", "mesh": true})"}) {
    EXPECT_EQ(validate(*render_request_from_json(nlohmann::json::parse(text))).error().code, Code::kInvalidArgument) << text;
  }
}

}  // namespace
}  // namespace radfarm
