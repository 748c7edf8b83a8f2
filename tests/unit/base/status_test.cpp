#include "base/status.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

Result<int> half(int x) {
  if (x % 2 != 0) return fail(Code::kInvalidArgument, std::to_string(x) + " is odd");
  return x / 2;
}

Result<int> quarter(int x) {
  RADFARM_TRY(const int h, half(x));
  RADFARM_TRY(const int q, half(h));
  return q;
}

Status check(int x) {
  RADFARM_TRY_STATUS(quarter(x));
  return {};
}

TEST(Status, TryPassesValuesOnAndErrorsUp) {
  EXPECT_EQ(quarter(8).value(), 2);
  EXPECT_EQ(quarter(6).error(), (Error{Code::kInvalidArgument, "3 is odd"}));
  EXPECT_TRUE(check(4));
  EXPECT_EQ(check(1).error().message, "1 is odd");
}

TEST(Status, AnnotatePutsThePlaceFirst) {
  const Result<int> result = annotate(quarter(6).error(), "scene.gltf");
  EXPECT_EQ(result.error().message, "scene.gltf: 3 is odd");
  EXPECT_EQ(result.error().code, Code::kInvalidArgument);
}

}  // namespace
}  // namespace radfarm
