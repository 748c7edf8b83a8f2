#include "scene/ies.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>

#include <gmock/gmock.h>

#include "base/file.h"
#include "scene/photometry.h"

namespace radfarm {
namespace {

using testing::HasSubstr;
constexpr double kPiD = std::numbers::pi;

/// A file of these tables: type, vertical and horizontal angles, candela.
std::string ies(int type, const std::string& vertical, const std::string& horizontal, const std::string& candela,
                const std::string& factors = "1 1 10") {
  const auto count = [](const std::string& list) {
    return std::to_string(1 + std::count(list.begin(), list.end(), ' '));
  };
  return "IESNA:LM-63-2002\n[LUMINAIRE] Test lamp\nTILT=NONE\n1 1000 1 " + count(vertical) + " " + count(horizontal) +
         " " + std::to_string(type) + " 2 0 0 0\n" + factors + "\n" + vertical + "\n" + horizontal + "\n" + candela +
         "\n";
}

Photometry table(const std::string& text) {
  const Result<Photometry> photometry = read_ies(text);
  EXPECT_TRUE(photometry) << photometry.error().message;
  return photometry.value_or(Photometry());
}

/// Above the origin, shining down; C0 along +x.
PunctualLight hanging() {
  PunctualLight light;
  light.position = {0, 3, 0};
  light.direction = {0, -1, 0};
  light.right = {1, 0, 0};
  return light;
}

TEST(Ies, AnEvenLightHasFourPiLumens) {
  const Photometry even = table(ies(1, "0 90 180", "0", "7 7 7"));
  EXPECT_NEAR(zonal_lumens(even), 28 * kPiD, 1e-9);
  EXPECT_EQ(even.name, "Test lamp");
  EXPECT_EQ(candela(even, normalize(Vec3(1, 2, 3)), hanging()), 7);
  EXPECT_EQ(max_candela(even), 7);
  // The lower half alone, and in other symmetries.
  EXPECT_NEAR(zonal_lumens(table(ies(1, "0 45 90", "0 45 90", "7 7 7 7 7 7 7 7 7"))), 14 * kPiD, 1e-9);
  EXPECT_NEAR(zonal_lumens(table(ies(1, "90 180", "0 180 360", "7 7 7 7 7 7"))), 14 * kPiD, 1e-9);
}

TEST(Ies, FactorsMultiply) {
  const std::string text = ies(1, "0 180", "0", "10 10", "0.5 0.25 10");
  EXPECT_EQ(table(text).candela[0], 5);
  // Up to 1991 the second one is the ballast-lamp photometric factor.
  std::string old = text;
  old.replace(0, 16, "IESNA91");
  EXPECT_EQ(table(old).candela[0], 1.25F);
  EXPECT_EQ(table(text.substr(text.find('['))).candela[0], 1.25F);  // 1986 has no first line
}

TEST(Ies, TiltIsSkippedOrRefused) {
  std::string text = ies(1, "0 180", "0", "10 10");
  text.replace(text.find("TILT=NONE"), 9, "TILT=INCLUDE\n1\n3\n0 45,90\n1 .9 .8");
  EXPECT_EQ(table(text).candela[0], 10);
  text.replace(text.find("TILT=INCLUDE"), 12, "TILT=lamp.tlt");
  EXPECT_EQ(read_ies(text).error().code, Code::kUnimplemented);
  EXPECT_THAT(read_ies(text).error().message, HasSubstr("line 3"));
}

TEST(Ies, NumbersMayBeSpreadAnyhow) {
  const std::string text = ies(1, "0 90 180", "0", "1 2 3");
  std::string spread = text;
  for (std::size_t i = spread.find("1 1000"); i < spread.size(); ++i) {
    if (spread[i] == ' ') spread.replace(i, 1, i % 2 == 0 ? "\r\n" : ",\t");
  }
  EXPECT_EQ(table(spread).candela, table(text).candela);
}

TEST(Photometry, LooksUpLinearlyAndMirrored) {
  // A quarter: intensity grows with C and falls with gamma.
  const Photometry quarter = table(ies(1, "0 90", "0 90", "100 0 100 50"));
  const PunctualLight light = hanging();
  const auto at = [&](double gamma, double c) {
    const double g = gamma / 180 * kPiD, angle = c / 180 * kPiD;
    // Counter-clockwise seen from above, which is from +y: from +x to -z.
    const Vec3d way(std::sin(g) * std::cos(angle), -std::cos(g), -std::sin(g) * std::sin(angle));
    return static_cast<double>(candela(quarter, to_float(way), light));
  };
  EXPECT_NEAR(at(0, 0), 100, 1e-4);
  EXPECT_NEAR(at(45, 0), 50, 1e-4);
  EXPECT_NEAR(at(45, 90), 75, 1e-4);
  EXPECT_NEAR(at(45, 45), 62.5, 1e-4);
  for (const double c : {10.0, 80.0}) {
    EXPECT_NEAR(at(30, 180 - c), at(30, c), 1e-4);
    EXPECT_NEAR(at(30, 180 + c), at(30, c), 1e-4);
    EXPECT_NEAR(at(30, 360 - c), at(30, c), 1e-4);
  }
  EXPECT_EQ(at(91, 90), 0);
  // All around, the order of C tells: 90 is where -z is.
  const Photometry whole = table(ies(1, "0 180", "0 90 180 270 360", "0 0 9 9 0 0 0 0 0 0"));
  EXPECT_NEAR(candela(whole, {0, 0, -1}, light), 9, 1e-4F);
  EXPECT_NEAR(candela(whole, {0, 0, 1}, light), 0, 1e-4F);
}

TEST(Photometry, LightsTheFloorAsByHand) {
  // E = I cos(gamma) / d^2 at places on a floor 3 m below.
  const Photometry quarter = table(ies(1, "0 30 60 90", "0 90", "900 600 300 0 900 700 350 0"));
  const PunctualLight light = hanging();
  const auto lux = [&](double x, double z) {
    const Vec3d offset = Vec3d(x, 0, z) - to_double(light.position);
    const double d = length(offset);
    return static_cast<double>(candela(quarter, to_float(offset / d), light)) * (3 / d) / (d * d);
  };
  EXPECT_NEAR(lux(0, 0), 100, 1e-4);
  EXPECT_NEAR(lux(std::sqrt(3.0), 0), 600 * std::pow(std::cos(kPiD / 6), 3) / 9, 1e-4);
  EXPECT_NEAR(lux(0, 3 * std::sqrt(3.0)), 350 * std::pow(0.5, 3) / 9, 1e-4);
  EXPECT_NEAR(lux(0, -3), 525 * std::pow(0.5, 1.5) / 9, 1e-4);  // gamma 45
}

TEST(Ies, PlanesFrom90To270AreMirroredIntoTheOtherHalf) {
  const Photometry full = table(ies(1, "0 90", "90 135 180 225 270", "1 2 1 3 1 4 1 5 1 6"));
  EXPECT_EQ(full.c, (std::vector<float>{0, 45, 90, 135, 180, 225, 270, 315, 360}));
  const auto at = [&](double c) { return candela_at(full, 90, c); };
  EXPECT_EQ(at(90), 2);
  EXPECT_EQ(at(180), 4);
  EXPECT_EQ(at(0), 4);
  EXPECT_EQ(at(45), 3);
  EXPECT_EQ(at(315), 5);
  EXPECT_NEAR(at(359.999999), at(0.000001), 1e-6);
}

TEST(Ies, PlanesThatEndBefore360CloseTheCircle) {
  const Photometry full = table(ies(1, "0 90", "0 120 240", "1 2 1 3 1 4"));
  EXPECT_EQ(full.c.back(), 360);
  EXPECT_NEAR(candela_at(full, 90, 300), 3, 1e-6);
}

TEST(Ies, TypesAAndBKeepTheirLumensAndTheirPlaces) {
  // An even light of half a sphere.
  for (const int type : {2, 3}) {
    EXPECT_NEAR(zonal_lumens(table(ies(type, "-90 0 90", "-90 0 90", "5 5 5 5 5 5 5 5 5"))), 10 * kPiD,
                1e-3 * 10 * kPiD);
    EXPECT_NEAR(zonal_lumens(table(ies(type, "0 90", "0 90", "5 5 5 5"))), 10 * kPiD, 1e-3 * 10 * kPiD);
  }
  // A light of 8 cd in a window of latitude and longitude 20 degrees: solid angle 2 sin(10 degrees) times 20 degrees.
  const double window = 2 * std::sin(10 * kPiD / 180) * 20 * kPiD / 180;
  for (const int type : {2, 3}) {
    const Photometry c = table(ies(type, "-10 10", "-10 10", "8 8 8 8"));
    EXPECT_NEAR(zonal_lumens(c), 8 * window, 1e-3 * 8 * window);
    EXPECT_EQ(candela_at(c, 0, 0), candela_at(c, 5, 77));
    EXPECT_EQ(candela_at(c, 12, 0), 0);
  }
  // Brighter to the right (H) and up (V): right is C0, up is C90.
  for (const int type : {2, 3}) {
    const Photometry c = table(ies(type, "-30 0 30", "-30 0 30", "0 0 0 1 1 9 4 4 4"));
    EXPECT_NEAR(candela_at(c, 0, 0), 1, 0.01);
    EXPECT_NEAR(candela_at(c, 30, 0), 4, 0.05);
    EXPECT_NEAR(candela_at(c, 30, 180), 0, 0.05);
    EXPECT_NEAR(candela_at(c, 30, 90), 9, 0.1);
    EXPECT_NEAR(candela_at(c, 30, 270), 1, 0.05);
  }
}

TEST(Ies, AWrongFileGivesItsLine) {
  struct Wrong {
    std::string text;
    const char* message;
  };
  const std::string good = ies(1, "0 90", "0", "1 2");
  for (const Wrong& wrong :
       {Wrong{"", "TILT="}, Wrong{"IESNA:LM-63-2002\nno more\n", "TILT="},
        Wrong{ies(1, "0 90", "0", "1 x"), "line 8: 'x' is no number"},
        Wrong{ies(1, "0 90", "0", "1 -2"), "line 8: -2 is out of range for candela values"},
        Wrong{ies(1, "0 90", "0", "1 inf"), "line 8"}, Wrong{ies(1, "0 90", "0", "1"), "ends before"},
        Wrong{ies(1, "0 90 45", "0", "1 2 3"), "line 6: vertical angles do not ascend"},
        Wrong{ies(1, "0 90", "0 45", "1 2 3 4"), "horizontal angles of type C"},
        Wrong{ies(1, "-90 90", "0", "1 2"), "vertical angles of type C"},
        Wrong{ies(4, "0 90", "0", "1 2"), "photometric type"},
        Wrong{ies(2, "10 90", "0 90", "1 2 3 4"), "types A and B"}, Wrong{ies(2, "0 90", "0", "1 2"), "types A and B"},
        Wrong{good.substr(0, good.size() * 3 / 4), "ends before"}}) {
    const Result<Photometry> photometry = read_ies(wrong.text);
    ASSERT_FALSE(photometry) << wrong.text;
    EXPECT_EQ(photometry.error().code, Code::kInvalidArgument);
    EXPECT_THAT(photometry.error().message, HasSubstr(wrong.message));
    EXPECT_EQ(photometry.error().message.find('\n'), std::string::npos);
  }
}

TEST(Ies, HostileCountsTakeNoMemory) {
  for (const char* counts : {"1000000000 1000000000", "4096 4096", "99999 2"}) {
    const auto many = read_ies("TILT=NONE\n1 1 1 " + std::string(counts) + " 1 1 0 0 0 1 1 1 0 90");
    ASSERT_FALSE(many);
    EXPECT_EQ(many.error().code, Code::kResourceExhausted);
  }
  EXPECT_EQ(read_ies("TILT=NONE\n1 1 1 4000 900 1 1 0 0 0 1 1 1 0 90").error().code, Code::kInvalidArgument);
  const std::string good = ies(2, "-10 0 10", "-10 10", "1 2 3 4 5 6");
  for (std::size_t size = 0; size < good.size() - 2; ++size)
    EXPECT_FALSE(read_ies(good.substr(0, size)) && size < good.size() - 3);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string damaged = good;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x1d);
    if (const auto read = read_ies(damaged)) {
      EXPECT_TRUE(std::isfinite(zonal_lumens(*read)));
    }
  }
}

TEST(RealIes, HasTheLumensOfTheOracle) {
  const char* set = std::getenv("RADFARM_SHARED");
  const std::filesystem::path shared =
      set != nullptr ? set : std::filesystem::path(RADFARM_SOURCE_DIR).parent_path() / "shared";
  if (!std::filesystem::is_directory(shared / "scenes/ies"))
    GTEST_SKIP() << "no scenes/ies in $RADFARM_SHARED or ../shared";
  struct Oracle {
    const char* file;
    double lumens;
  };
  for (const Oracle& oracle : {Oracle{"examp1.ies", 5297.39}, Oracle{"ASA_15M_R2.ies", 9560.97}}) {
    const Photometry photometry = table(*read_file(shared / "scenes/ies" / oracle.file, 1U << 20U));
    EXPECT_NEAR(zonal_lumens(photometry), oracle.lumens, 1e-3 * oracle.lumens) << oracle.file;
    RecordProperty(oracle.file, std::to_string(zonal_lumens(photometry)));
  }
}

}  // namespace
}  // namespace radfarm
