#include "cli/deliver.h"

#include <gtest/gtest.h>

namespace radfarm::cli {
namespace {

TEST(CheckUsage, WantsFilesOfTheRightKinds) {
  EXPECT_TRUE(check_usage({"a.exr", "a.png", "a.json", "-1.5"}));
  EXPECT_TRUE(check_usage({"a.exr", {}, {}, "auto"}));
  EXPECT_FALSE(check_usage({"a.png", {}, {}, "auto"}));
  EXPECT_FALSE(check_usage({"a.exr", "a.jpg", {}, "auto"}));
  EXPECT_TRUE(check_usage({"a.exr", {}, "a.html", "auto"}));
  EXPECT_EQ(check_usage({"a.exr", {}, "a.txt", "auto"}).error().code, Code::kInvalidArgument);
  EXPECT_FALSE(check_usage({"a.exr", {}, {}, "bright"}));
  EXPECT_FALSE(check_usage({"a.exr", {}, {}, "nan"}));
}

TEST(CheckUsage, PicturesOfAovsNeedAovs) {
  const Outputs outputs{"a.exr", {}, {}, "auto", "pictures"};
  RenderRequest request;
  EXPECT_FALSE(check_usage(outputs, request));
  request.aov = {"all"};
  EXPECT_TRUE(check_usage(outputs, request));
  EXPECT_TRUE(check_usage(outputs)) << "fetch knows no request";
  EXPECT_TRUE(check_usage({"a.exr", {}, {}, "auto"}, RenderRequest()));
}

TEST(CheckFolders, SaysBeforeTheRenderThatAFolderIsMissing) {
  EXPECT_FALSE(check_folders({"/nonexistent/a.exr", {}, {}, "auto"}));
  EXPECT_TRUE(check_folders({"/tmp/a.exr", {}, {}, "auto"}));
  EXPECT_TRUE(check_folders({"/tmp/a.exr", {}, {}, "auto", "/tmp"}));
  EXPECT_FALSE(check_folders({"/tmp/a.exr", {}, {}, "auto", "/nonexistent/pictures"}));
}

TEST(CheckSucceeded, TellsFailedFromCancelled) {
  JobStatus job;
  job.state = JobState::kSucceeded;
  EXPECT_TRUE(check_succeeded(job));
  job.state = JobState::kCancelled;
  EXPECT_EQ(check_succeeded(job).error().code, Code::kCancelled);
  job.state = JobState::kFailed;
  job.failure = {JobFailure::Reason::kSceneInvalid, {Code::kNotFound, "room.gltf: no camera"}};
  EXPECT_EQ(check_succeeded(job).error(), (Error{Code::kInvalidArgument, "room.gltf: no camera"}));
}

}  // namespace
}  // namespace radfarm::cli
