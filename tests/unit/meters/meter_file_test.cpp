#include "meters/meter_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace radfarm {
namespace {

using testing::HasSubstr;

TEST(MeterFile, ReadsPointsWithAndWithoutNormals) {
  const auto meters = read_meters("x,y,z\n# desk\n1, 2,3\r\n\n4,5,6,0,0,-2\n", {1, 0, 0});
  ASSERT_TRUE(meters) << meters.error().message;
  ASSERT_EQ(meters->size(), 2U);
  EXPECT_EQ((*meters)[0].point, Vec3(0, 2, 3));
  EXPECT_EQ((*meters)[0].normal, Vec3(0, 1, 0));
  EXPECT_EQ((*meters)[1].normal, Vec3(0, 0, -1));
}

TEST(MeterFile, SaysWhichLineIsWrong) {
  const auto message = [](const char* csv) {
    const auto meters = read_meters(csv, {0, 0, 0});
    return meters ? std::string("accepted") : meters.error().message;
  };
  EXPECT_THAT(message("1,2,3\n1,2\n"), HasSubstr("line 2: needs x,y,z"));
  EXPECT_THAT(message("1,2,3\nx,y,z\n"), HasSubstr("line 2: 'x,y,z' is not numbers"));
  EXPECT_THAT(message("1,2,nan\n2,2,inf\n"), HasSubstr("line 2"));
  EXPECT_THAT(message("1,2,3,0,0,0\n"), HasSubstr("line 1: the normal has no direction"));
  EXPECT_THAT(message("x,y,z\n"), HasSubstr("has no points"));
  EXPECT_THAT(message(""), HasSubstr("has no points"));
}

TEST(MeterFile, WritesTheFilesCoordinates) {
  const std::vector<Meter> meters{{{1, 2, 3}, {0, 1, 0}}};
  const std::vector<Reading> readings{{SpectrumD(10), .5, 7}};
  EXPECT_EQ(write_readings(meters, readings, {100, 0, 0}),
            "x,y,z,nx,ny,nz,lux,lux_low,lux_high,red,green,blue,samples\n101,2,3,0,1,0,10,9.5,10.5,10,10,10,7\n");
}

}  // namespace
}  // namespace radfarm
