#include "support/statistics.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace radfarm::test {
namespace {

TEST(ChiSquare, PValuesAreThoseOfTheTables) {
  // One observed 0, one 2k: statistic and p are closed forms for 2 degrees of freedom: p = exp(-statistic / 2).
  const ChiSquare two = chi_square(std::array{30.0, 10.0, 20.0}, std::array{20.0, 20.0, 20.0});
  EXPECT_DOUBLE_EQ(two.statistic, 10.0);
  EXPECT_EQ(two.degrees_of_freedom, 2);
  EXPECT_NEAR(two.p_value, std::exp(-5.0), 1e-15);
  // One degree of freedom: p = erfc(sqrt(statistic / 2)).
  const ChiSquare one = chi_square(std::array{60.0, 40.0}, std::array{50.0, 50.0});
  EXPECT_NEAR(one.p_value, std::erfc(std::sqrt(2.0)), 1e-15);
  // 95 % points of the printed table: 10 degrees 18.307, 100 degrees 124.342.
  EXPECT_NEAR(regularized_gamma_q(5, 18.307038053275146 / 2), 0.05, 1e-13);
  EXPECT_NEAR(regularized_gamma_q(50, 124.34211340400407 / 2), 0.05, 1e-13);
}

TEST(ChiSquare, SmallCellsArePooled) {
  const ChiSquare test = chi_square(std::array{3.0, 2.0, 5.0, 10.0}, std::array{2.0, 3.0, 5.0, 10.0});
  EXPECT_EQ(test.degrees_of_freedom, 2);
  EXPECT_DOUBLE_EQ(test.statistic, 0);
}

TEST(ChiSquare, CountsWhereNothingIsExpectedAreImpossible) {
  EXPECT_EQ(chi_square(std::array{1.0, 99.0}, std::array{0.0, 100.0}).p_value, 0);
}

TEST(ChiSquare, PdfThatDoesNotIntegrateToOneIsRejected) {
  EXPECT_EQ(chi_square(std::array{50.0, 50.0}, std::array{55.0, 55.0}).p_value, 0);
}

TEST(RegularizedGamma, HalvesAddUpToOne) {
  for (const double a : {0.5, 1.0, 3.5, 40.0, 400.0}) {
    for (const double x : {0.01, 0.7, 3.0, 39.0, 410.0, 900.0}) {
      EXPECT_NEAR(regularized_gamma_p(a, x) + regularized_gamma_q(a, x), 1, 1e-12);
    }
    EXPECT_NEAR(regularized_gamma_p(1.0, a), -std::expm1(-a), 1e-13);
  }
}

TEST(Sidak, FamilyOfTestsHasTheLevelAsked) {
  const double level = sidak_level(1e-6, 20);
  EXPECT_NEAR(1 - std::pow(1 - level, 20), 1e-6, 1e-12);
  EXPECT_DOUBLE_EQ(sidak_level(0.05, 1), 0.05);
}

TEST(ZTest, PValuesAreTheNormalLaws) {
  EXPECT_NEAR(z_test(1.959963984540054, 1, 0), 0.05, 1e-15);
  EXPECT_NEAR(z_test(-5, 1, 0), 5.733031437583867e-07, 1e-18);
  EXPECT_EQ(z_test(1, 0, 1), 1);
  EXPECT_EQ(z_test(2, 0, 1), 0);
}

}  // namespace
}  // namespace radfarm::test
