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

TEST(ParseChildPhase, ReadsTheChildsLine) {
  EXPECT_EQ(parse_child_phase(R"({"phase":"radiosity: links","done":7,"total":4294967296})"),
            (JobPhase{"radiosity: links", 7, 4294967296}));
  EXPECT_EQ(parse_child_phase(R"({"phase":"load"})"), (JobPhase{"load", 0, 0}));
  EXPECT_EQ(parse_child_phase(R"({"phase":"load","done":-1,"total":"x"})"), (JobPhase{"load", 0, 0}));
}

TEST(ParseChildPhase, GivesNothingForOtherLines) {
  const std::string huge = R"({"phase":")" + std::string(101, 'x') + R"("})";
  for (const std::string& line : {std::string(), std::string("[]"), std::string(R"({"code":3,"message":"x"})"),
                                  std::string(R"({"phase":3})"), std::string(R"({"phase":"\u001b[2J"})"), huge}) {
    EXPECT_EQ(parse_child_phase(line), std::nullopt) << line;
  }
}

}  // namespace
}  // namespace radfarm
