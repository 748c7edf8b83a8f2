#include "coordinator/prepare_child.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(ParseChildError, ReadsTheChildsLine) {
  const std::optional<Error> error = parse_child_error(R"({"code":3,"message":"room.gltf: /meshes/0: no indices"})");
  EXPECT_EQ(error, (Error{Code::kInvalidArgument, "room.gltf: /meshes/0: no indices"}));
}

TEST(ParseChildError, GivesNothingForOtherLines) {
  for (const char* line : {"", "Segmentation fault", "[]", "{}", R"({"code":"3","message":"x"})", R"({"code":3})"}) {
    EXPECT_EQ(parse_child_error(line), std::nullopt) << line;
  }
}

}  // namespace
}  // namespace radfarm
