#include "frame/audit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "estimate/audit_pixels.h"
#include "math/statistics.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

constexpr double kTrueError = 0.3;  // RMS of what the image is off by, chosen below
constexpr double kNoise = 0.5;      // of one estimate

Settings audited(std::uint64_t seed) {
  Settings settings;
  settings.width = 40, settings.height = 30;
  settings.audit_pixels = 300;
  settings.seed = seed;
  return settings;
}

PixelSums grey(double direct, double indirect) {
  PixelSums sums;
  sums.direct = SpectrumD(direct);
  sums.indirect = SpectrumD(indirect);
  sums.samples = 1;
  return sums;
}

/// An image whose error is known: the truth is 2 + 1 everywhere; half of each pixel's error is in either part.
struct Synthetic {
  Raster raster;
  std::vector<AuditResult> audits;
  double mse = 0;
};

Synthetic make(const Settings& settings) {
  Synthetic s;
  RandomSequence random(combine(settings.seed, 1));
  const auto pixels = static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  for (std::size_t i = 0; i < pixels; ++i) {
    // Uniform in +-sqrt(3) kTrueError has RMS kTrueError.
    const double error = (2 * random.uniform_double() - 1) * std::sqrt(3.0) * kTrueError;
    s.raster.pixels.push_back(grey(2 + error / 2, 1 + error / 2));
    s.mse += error * error / static_cast<double>(pixels);
  }
  const auto noise = [&] { return (2 * random.uniform_double() - 1) * std::sqrt(3.0) * kNoise; };
  AuditResult result;
  for (const AuditPixel& p : choose_audit_pixels(settings.width, settings.height, settings.audit_pixels, settings.seed)) {
    AuditResult::Pixel pixel{p.x, p.y, {}, {}};
    pixel.first = grey(2 + noise(), 1 + noise());
    pixel.second = grey(2 + noise(), 1 + noise());
    result.pixels.push_back(pixel);
  }
  s.audits.push_back(result);
  return s;
}

TEST(Audit, MeasuresTheMseWithoutBias) {
  RunningStatistics difference, mean;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Settings settings = audited(seed);
    const Synthetic s = make(settings);
    const Accuracy accuracy = *audit(settings, first_round(settings), s.raster, s.audits);
    difference.add(accuracy.direct_mse + accuracy.indirect_mse - s.mse);
    mean.add(accuracy.mean);
  }
  const double level = test::sidak_level(1e-6, 2);
  EXPECT_GT(test::z_test(difference.mean(), difference.standard_error(), 0), level);
  EXPECT_GT(test::z_test(mean.mean(), mean.standard_error(), 3), level);
}

TEST(Audit, ItsIntervalCoversTheTruthNineTimesInTen) {
  // 200 runs of a nominal 95 %: fewer than 180 covered has a chance of 2e-3 at exactly 95 %, and the seeds are fixed.
  int covered = 0;
  for (std::uint64_t seed = 1000; seed < 1200; ++seed) {
    const Settings settings = audited(seed);
    const Synthetic s = make(settings);
    const Accuracy accuracy = *audit(settings, first_round(settings), s.raster, s.audits);
    ASSERT_TRUE(accuracy.rmse.has_value());
    EXPECT_LE(accuracy.rmse->lower, accuracy.rmse->upper);
    const double truth = std::sqrt(s.mse);
    covered += accuracy.rmse->lower <= truth && truth <= accuracy.rmse->upper ? 1 : 0;
  }
  EXPECT_GE(covered, 180);
}

TEST(Audit, ItsStandardErrorIsWhatTheFigureScattersBy) {
  RunningStatistics mse;
  double stated = 0;
  for (std::uint64_t seed = 2000; seed < 2300; ++seed) {
    const Settings settings = audited(seed);
    const Synthetic s = make(settings);
    const Accuracy accuracy = *audit(settings, first_round(settings), s.raster, s.audits);
    mse.add(accuracy.mse - s.mse);
    stated += accuracy.mse_error / 300;
    EXPECT_LE(accuracy.audit_noise, accuracy.mse_error);
    EXPECT_GE(*accuracy.surely_below, accuracy.relative_rmse->upper);
  }
  // A standard deviation from 300 values is within 4 / sqrt(600) of itself but for one false alarm in 16000.
  EXPECT_NEAR(stated / std::sqrt(mse.variance()), 1, 0.17);
}

TEST(Audit, SaysWhatASinglePathVaries) {
  const Settings settings = audited(8);
  Synthetic s = make(settings);
  for (AuditResult::Pixel& pixel : s.audits[0].pixels) {
    for (PixelSums* estimate : {&pixel.first, &pixel.second}) {
      *estimate = {};
      for (int i = 0; i < 4; ++i) estimate->add({{}, Spectrum(i % 2 == 0 ? 2.0F : 4.0F), {}, {}});
    }
  }
  const Accuracy accuracy = *audit(settings, first_round(settings), s.raster, s.audits);
  EXPECT_NEAR(accuracy.path_variance, 4.0 / 3, 1e-9) << "2, 4, 2, 4: a sample variance of 4/3";
}

TEST(Audit, OfAnotherRoundHasOtherPixels) {
  const Settings settings = audited(9);
  Round second = first_round(settings);
  second.number = 1;
  const Synthetic s = make(settings);
  EXPECT_EQ(audit(settings, second, s.raster, s.audits).error().code, Code::kDataLoss);
}

TEST(Audit, PartsAndChannelsAddUpToTheMse) {
  const Settings settings = audited(5);
  const Synthetic s = make(settings);
  const Accuracy accuracy = *audit(settings, first_round(settings), s.raster, s.audits);
  ASSERT_TRUE(accuracy.rmse && accuracy.rmse->value);
  const double mse = *accuracy.rmse->value * *accuracy.rmse->value;
  EXPECT_NEAR(accuracy.direct_mse + accuracy.indirect_mse, mse, 1e-12);
  for (const double channel : accuracy.channel_mse) EXPECT_NEAR(channel, mse, 1e-12);  // grey
  EXPECT_NEAR(*accuracy.relative_rmse->value, *accuracy.rmse->value / accuracy.mean, 1e-12);
}

TEST(Audit, ItsMapSaysWhereTheErrorIs) {
  // Only the bottom right twelfth is off, by 1 everywhere.
  const Settings settings = audited(1);
  Synthetic s = make(settings);
  for (std::size_t i = 0; i < s.raster.pixels.size(); ++i) {
    const std::size_t x = i % 40, y = i / 40;
    s.raster.pixels[i] = grey(x >= 30 && y >= 20 ? 3 : 2, 1);
  }
  for (AuditResult::Pixel& pixel : s.audits[0].pixels) pixel.first = pixel.second = grey(2, 1);
  const Accuracy accuracy = *audit(settings, first_round(settings), s.raster, s.audits);
  double all = 0, there = 0;
  for (std::size_t k = 0; k < accuracy.map_mse.size(); ++k) {
    all += accuracy.map_mse[k];
    if (k % Accuracy::kMapColumns >= 6 && k / Accuracy::kMapColumns >= 4) there += accuracy.map_mse[k];
  }
  EXPECT_NEAR(all, accuracy.mse, 1e-12);
  EXPECT_NEAR(there, accuracy.mse, 1e-12);
  EXPECT_GT(accuracy.mse, 0.05);
}

TEST(Audit, APerfectImageMeasuresBelowWhatItCanResolve) {
  const Settings settings = audited(6);
  Synthetic s = make(settings);
  for (PixelSums& pixel : s.raster.pixels) pixel = grey(2, 1);
  const Accuracy accuracy = *audit(settings, first_round(settings), s.raster, s.audits);
  ASSERT_TRUE(accuracy.rmse);
  // Either nothing can be resolved, or the interval reaches 0.
  EXPECT_TRUE(!accuracy.rmse->value || accuracy.rmse->lower == 0);
  EXPECT_GT(accuracy.rmse->upper, 0);
}

TEST(Audit, ABlackImageHasNoError) {
  const Settings settings = audited(7);
  Synthetic s = make(settings);
  for (PixelSums& pixel : s.raster.pixels) pixel = grey(0, 0);
  for (AuditResult::Pixel& pixel : s.audits[0].pixels) pixel.first = pixel.second = grey(0, 0);
  const Accuracy accuracy = *audit(settings, first_round(settings), s.raster, s.audits);
  EXPECT_FALSE(accuracy.rmse);
  EXPECT_FALSE(accuracy.relative_rmse);
  EXPECT_EQ(accuracy.mean, 0);
}

TEST(Audit, RefusesPixelsThatTheSettingsDoNotChoose) {
  const Settings settings = audited(8);
  const Synthetic s = make(settings);
  for (int damage = 0; damage < 5; ++damage) {
    std::vector<AuditResult> audits = s.audits;
    std::vector<AuditResult::Pixel>& pixels = audits[0].pixels;
    if (damage == 0) pixels.pop_back();
    if (damage == 1) pixels.push_back(pixels[0]);
    if (damage == 2) pixels[3] = pixels[4];
    if (damage == 3) pixels[5].x = -1;
    if (damage == 4) pixels[6].second.samples = 0;
    EXPECT_EQ(audit(settings, first_round(settings), s.raster, audits).error().code, Code::kDataLoss) << damage;
  }
  EXPECT_EQ(audit(settings, first_round(settings), s.raster, {}).error().code, Code::kDataLoss);
}

}  // namespace
}  // namespace radfarm
