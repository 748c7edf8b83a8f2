#include "pipeline/next_round.h"

#include <cmath>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

using Step = NextRound::Step;

constexpr double kMean = 3;  // cd/m^2

/// A round as the audit and the samples have it: `error` relative RMSE, `noise` relative, of the samples. Its noise falls as
/// samples grow.
RoundFigures figures(double error, double noise, double bound) {
  RoundFigures f;
  f.level = 1;
  f.target_error = 0.02F;
  f.pixels = 256 * 256;
  f.round = {0, 1024, 64, 1};
  Accuracy a;
  a.audited_pixels = 1024;
  a.mean = kMean;
  a.mse = error * error * kMean * kMean;
  a.mse_error = 0.1 * a.mse + 1e-5;
  a.audit_noise = 0.5 * a.mse_error;
  a.path_variance = 0.3 * kMean * kMean;
  a.rmse = MeasuredError{error * kMean, 0.9 * error * kMean, bound * kMean};
  a.relative_rmse = MeasuredError{error, 0.9 * error, bound};
  a.surely_below = bound;
  f.accuracy = a;
  for (double scale = 1; scale <= 16; scale *= std::sqrt(2)) f.noise.push_back({scale, noise * noise / scale, 16 * scale});
  f.light_work = 1e7;
  f.audit_work = 1024 * 128 * 5.0;
  f.light_cpu_seconds = 8;
  f.audit_cpu_seconds = 1;
  f.wall_seconds = 5;
  f.prepare_cpu_seconds = 1;
  return f;
}

RoundsAsked asked(double error, std::uint32_t rounds_left = 3) { return {{error, 0}, false, rounds_left, 0, 0}; }

NextRound next(const RoundsAsked& asked, const RoundFigures& last) { return next_round(asked, {&last, 1}); }

TEST(NextRound, StopsWhereTheBoundIsBelowTheTarget) {
  const NextRound met = next(asked(0.05), figures(0.03, 0.03, 0.045));
  EXPECT_EQ(met.step, Step::kStop);
  EXPECT_EQ(met.target_met, true);
}

TEST(NextRound, AnErrorBelowTheTargetIsNotEnoughWhereItsBoundIsNot) {
  EXPECT_NE(next(asked(0.05), figures(0.03, 0.03, 0.055)).step, Step::kStop);
}

TEST(NextRound, NoiseTakesMoreSamplesAsManyAsItNeeds) {
  const RoundFigures last = figures(0.04, 0.04, 0.05);
  const NextRound more = next(asked(0.02), last);
  ASSERT_EQ(more.step, Step::kMoreSamples);
  EXPECT_EQ(more.round.number, 1U) << "fresh pixels, fresh paths";
  // Four times the samples leave the target; what is asked for is a little less, but not much.
  EXPECT_GT(more.round.scale, 4);
  EXPECT_LE(more.round.scale, 16);
  EXPECT_LT(next(asked(0.03), last).round.scale, more.round.scale);
}

TEST(NextRound, BiasTakesNewLight) {
  const NextRound anew = next(asked(0.02), figures(0.04, 0.01, 0.045));
  ASSERT_EQ(anew.step, Step::kNewLight);
  EXPECT_FALSE(anew.effort.by_paths);
  EXPECT_GT(*anew.effort.level, 1.4F);
  EXPECT_LE(*anew.effort.level, kMostLevel);
  EXPECT_EQ(anew.round.number, 1U);
}

TEST(NextRound, BiasThatFinerLightLeavesTakesPathsWhereTheIntegratorIsOurs) {
  std::vector<RoundFigures> rounds = {figures(0.04, 0.01, 0.045), figures(0.039, 0.01, 0.045)};
  rounds[1].round.number = 1;
  rounds[1].level = 2;
  rounds[1].kind = RoundFigures::Kind::kNewLight;
  RoundsAsked ours = asked(0.02);
  ours.may_trace_paths = true;
  const NextRound anew = next_round(ours, rounds);
  ASSERT_EQ(anew.step, Step::kNewLight);
  EXPECT_TRUE(anew.effort.by_paths);
  const NextRound given_up = next_round(asked(0.02), rounds);
  EXPECT_EQ(given_up.step, Step::kStop) << "neither samples nor light would help";
  EXPECT_EQ(given_up.target_met, false);
}

TEST(NextRound, PathsAreNotTracedWhereFinerLightCostsLess) {
  RoundsAsked ours = asked(0.02);
  ours.may_trace_paths = true;
  EXPECT_FALSE(next(ours, figures(0.04, 0.01, 0.045)).effort.by_paths);
  // Nor where noise is all, however much of it.
  RoundFigures noisy = figures(0.2, 0.2, 0.25);
  const NextRound more = next(ours, noisy);
  EXPECT_EQ(more.step, Step::kMoreSamples);
  // A job that was asked for a quality and is extended: new light has the noise of the new target.
  RoundFigures extended = figures(0.07, 0.06, 0.09);
  extended.target_error = 0;
  const NextRound anew = next(ours, extended);
  ASSERT_EQ(anew.step, Step::kNewLight);
  EXPECT_FALSE(anew.effort.by_paths);
  EXPECT_EQ(anew.round.scale, 1);
}

TEST(NextRound, PathsHaveNoBiasWhateverTheAuditFinds) {
  RoundFigures last = figures(0.04, 0.01, 0.045);
  last.integrator = Settings::Integrator::kPathTrace;
  EXPECT_EQ(next(asked(0.02), last).step, Step::kMoreSamples);
}

TEST(NextRound, ABlackImageStopsAndSaysNothing) {
  RoundFigures black = figures(0.04, 0.01, 0.045);
  black.accuracy->mean = 0;
  black.accuracy->relative_rmse.reset();
  black.accuracy->rmse.reset();
  black.accuracy->surely_below.reset();
  const NextRound next_one = next(asked(0.02), black);
  EXPECT_EQ(next_one.step, Step::kStop);
  EXPECT_EQ(next_one.target_met, std::nullopt);
}

TEST(NextRound, WhatTheAuditCannotResolveIsAuditedBetter) {
  RoundFigures last = figures(0.005, 0.01, 0.03);
  last.accuracy->mse = -1e-5;  // below what it resolves
  last.accuracy->mse_error = 3e-4 * kMean * kMean;
  last.accuracy->audit_noise = 2.9e-4 * kMean * kMean;
  last.accuracy->relative_rmse->value.reset();
  const NextRound again = next(asked(0.02), last);
  ASSERT_EQ(again.step, Step::kMoreSamples);
  const auto paths = [](const Round& round) { return std::uint64_t{round.audit_pixels} * round.audit_samples; };
  EXPECT_GT(paths(again.round), 2 * paths(last.round));
}

TEST(NextRound, StopsUnmetWhenRoundsAreUsedUp) {
  const NextRound end = next(asked(0.02, 0), figures(0.04, 0.04, 0.05));
  EXPECT_EQ(end.step, Step::kStop);
  EXPECT_EQ(end.target_met, false);
}

TEST(NextRound, AnImageThatWasNotAuditedIsAuditedFirst) {
  RoundFigures last = figures(0.04, 0.04, 0.05);
  last.accuracy.reset();
  last.round.scale = 3;
  const NextRound next_one = next(asked(0.02), last);
  ASSERT_EQ(next_one.step, Step::kMoreSamples);
  EXPECT_EQ(next_one.round.scale, 3);
  EXPECT_GE(next_one.round.audit_pixels, 512U);
}

TEST(NextRound, WhatWasMeasuredByAClockDoesNotDecideForAnError) {
  const RoundFigures last = figures(0.04, 0.04, 0.05);
  RoundFigures slow = last;
  slow.light_cpu_seconds = slow.wall_seconds = 1e5;
  EXPECT_EQ(next(asked(0.02), last).round, next(asked(0.02), slow).round);
}

TEST(NextRound, ATargetOfSecondsTakesAsManySamplesAsFit) {
  const RoundFigures last = figures(0.04, 0.04, 0.05);  // 5 s of wall time, 4.4 of them for 16 samples a pixel
  RoundsAsked time{{0, 60}, false, 3, 20, 1};
  const NextRound more = next(time, last);
  ASSERT_EQ(more.step, Step::kMoreSamples);
  EXPECT_GT(more.round.scale, 3);
  EXPECT_LT(more.round.scale, 5);
  EXPECT_EQ(more.target_met, std::nullopt);
  time.seconds_left = 3;
  EXPECT_EQ(next(time, last).step, Step::kStop);
  time.seconds_left = 20, time.rounds_left = 0;
  EXPECT_EQ(next(time, last).step, Step::kStop);
}

TEST(NextHalving, OfNoiseCostsAboutThreeTimesTheSamples) {
  const RoundFigures last = figures(0.04, 0.04, 0.05);
  const std::optional<NextHalving> halving = next_halving({&last, 1});
  ASSERT_TRUE(halving);
  EXPECT_GE(halving->cpu_seconds, 3 * last.light_cpu_seconds);
  EXPECT_LT(halving->cpu_seconds, 6 * last.light_cpu_seconds);
  EXPECT_STREQ(halving->from, "the noise of the samples");
}

TEST(NextHalving, OfBiasGoesByTheSlopeOverTheRounds) {
  std::vector<RoundFigures> rounds = {figures(0.04, 0.01, 0.045), figures(0.02, 0.005, 0.025)};
  rounds[1].light_cpu_seconds = 29;  // in all four times the first round's 10 s: an error that goes with the square root
  const std::optional<NextHalving> halving = next_halving(rounds);
  ASSERT_TRUE(halving);
  EXPECT_NEAR(halving->cpu_seconds, 3 * 41, 8);
  RoundFigures black = rounds[0];
  black.accuracy->rmse.reset();
  EXPECT_FALSE(next_halving({&black, 1}));
}

}  // namespace
}  // namespace radfarm
