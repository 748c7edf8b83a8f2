#include "pipeline/next_round.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/plan_audit.h"

namespace radfarm {
namespace {

using Step = NextRound::Step;

// The audit's bound that decides has 1 - .05 / kMostRounds on its side: so many standard errors above the value.
constexpr double kSureErrors = 2.24;
// What is predicted is to lie so far below the target's square.
constexpr double kSafety = .9;
// Shares of the target's square: bias that is in the way; what new light is to leave of it, and of noise.
constexpr double kMuchBias = .5, kBiasOfNewLight = .25, kNoiseOfNewLight = .35;
// Squared bias from level to level, where no two rounds have told it; and what of it shows that finer light does not help.
constexpr double kBiasPerLevel = .25, kUseless = .75;
constexpr float kLeastStep = .5F, kMostLevelOfPaths = 5;
constexpr double kPathsNoisePerLevel = .4;  // four times the photons, in narrower discs
constexpr double kWorkPerLevel = 3;      // of preparation and of a sample, about
constexpr double kPreparation = .5;      // of the light's work so far, about
// Audits may take a quarter of all, or half of what the last one took: what cannot tell whether a target is met is lost
// altogether.
constexpr double kAuditOfLight = 1. / 3, kLeastAudit = 0.5;
constexpr double kSmallAudit = 1e5;  // paths: a fraction of a second, whatever the light took
// Nothing is worth a round that leaves more of the squared error than this.
constexpr double kWorthwhile = .9;
// The error's logarithm over the CPU time's: where it falls more slowly than this, there is nothing to predict.
constexpr double kLeastSlope = 0.2;
// Of the seconds that are left, what a round may be expected to take; and what it must add to the samples.
constexpr double kShareOfLeft = .85, kLeastGrowth = 1.2;

/// The last round, taken apart. Shares of the mean squared.
struct Situation {
  double error = 0, target = 0;  // the target, and squared
  double mse = 0;
  double noise_scale = 1;  // audited noise over what samples say, where that is too much: they are stratified
  double bias = 0;         // squared
  double spread = 0;       // of the audit's pixels, as AuditNeeds has it
  double path_variance = 0;
  double path_work = 0;    // of one path of the audit
  double audited = 0;      // work of all audits so far
};

bool is_unbiased(const RoundFigures& f) { return f.integrator == Settings::Integrator::kPathTrace; }

double square(double x) { return x * x; }

Situation situation_of(double target, std::span<const RoundFigures> rounds) {
  const RoundFigures& last = rounds.back();
  const Accuracy& a = *last.accuracy;
  const double mean = square(a.mean), noise = last.noise[0].noise, error = a.mse_error / mean, audit_noise = a.audit_noise / mean;
  Situation s;
  s.error = target;
  s.target = square(target);
  s.mse = a.mse / mean;
  // A bias that the audit cannot tell from none is none.
  s.bias = is_unbiased(last) || s.mse - noise < error ? 0 : s.mse - noise;
  const double measured = std::max(s.mse + error, 0.25 * noise);
  s.noise_scale = noise > 0 ? std::min(1.0, std::max(measured, 0.0) / noise) : 1;
  if (is_unbiased(last) && noise > 0) s.noise_scale = std::clamp((s.mse + error) / noise, 0.25, 2.0);
  const double pixels = a.audited_pixels, by_pixels = std::sqrt(std::max(0.0, square(error) - square(audit_noise)));
  const double size = std::max(s.mse, noise);
  s.spread = size > 0 ? std::clamp(by_pixels * std::sqrt(pixels) / size, 2.0, 30.0) : 5;
  s.path_variance = audit_noise * std::sqrt(pixels) * last.round.audit_samples;
  for (const RoundFigures& f : rounds) s.audited += f.audit_work;
  s.path_work = last.audit_work / (2 * pixels * std::max(1U, last.round.audit_samples));
  return s;
}

/// A way to go on, and what it is expected to lead to.
struct Way {
  NextRound next;
  double work = 0;
  double mse = std::numeric_limits<double>::infinity();
  bool is_enough = false;
};

/// Audit of an image that should have this squared error, within a share of the light's work; whether it may tell that the
/// target is met.
struct Audit {
  AuditPlan plan;
  bool tells = false;
};

Audit audit_for(const Situation& s, const RoundFigures& last, double mse, double light_work) {
  AuditNeeds needs;
  needs.mse = mse;
  needs.spread = s.spread;
  needs.path_variance = s.path_variance;
  needs.most_error = std::max(0.02 * s.target, (kSafety * s.target - mse) / kSureErrors);
  const double least = std::max(kLeastAudit * last.audit_work, kSmallAudit * s.path_work);
  const double affordable = std::max(kAuditOfLight * light_work - s.audited, least);
  needs.most_paths = s.path_work > 0 ? affordable / s.path_work : 0;
  needs.all_pixels = last.pixels;
  const AuditPlan plan = plan_audit(needs);
  return {plan, mse + kSureErrors * plan.error <= kSafety * s.target};
}

Round round_after(const RoundFigures& last, const AuditPlan& plan, double scale) {
  return {last.round.number + 1, plan.pixels, plan.samples, scale};
}

/// The fewest samples that are expected to do, or else the most that a round may take.
Way more_samples(const Situation& s, const RoundFigures& last) {
  Way way;
  for (const NoiseAt& at : last.noise) {
    const double growth = last.noise[0].samples > 0 ? at.samples / last.noise[0].samples : 1;
    const double mse = s.bias + s.noise_scale * at.noise, light = last.light_work * growth;
    const Audit audit = audit_for(s, last, mse, light);
    way.next = {Step::kMoreSamples, {}, round_after(last, audit.plan, at.scale), {}};
    way.work = light - last.light_work + audit.plan.paths() * s.path_work;
    way.mse = mse;
    way.is_enough = audit.tells;
    if (way.is_enough) return way;
  }
  return way;
}

/// Squared bias from one level to the next, as rounds have shown it.
double bias_per_level(std::span<const RoundFigures> rounds) {
  const auto bias = [](const RoundFigures& f) {
    return std::max(f.accuracy->mse / square(f.accuracy->mean) - f.noise[0].noise, 0.0);
  };
  const RoundFigures& last = rounds.back();
  for (std::size_t i = rounds.size() - 1; i-- > 0;) {
    const RoundFigures& f = rounds[i];
    const bool tells = f.accuracy && f.accuracy->relative_rmse && f.integrator == last.integrator && f.level < last.level - 0.25F;
    if (!tells || !(bias(f) > 0)) continue;
    return std::clamp(std::pow(bias(last) / bias(f), 1 / static_cast<double>(last.level - f.level)), 0.05, 1.0);
  }
  return kBiasPerLevel;
}

/// What new light is to keep of noise: by the first scale at which `times` the noise is below a share of the target's square,
/// or the largest. Settings for the same target have the same samples at scale 1; for another one they have what it is likely
/// to need.
NoiseAt noise_of_new_light(const Situation& s, const RoundFigures& last, double times) {
  const double wanted = kNoiseOfNewLight * s.target, now = s.noise_scale * times * last.noise[0].noise;
  if (last.target_error != static_cast<float>(s.error)) return {1, wanted, last.noise[0].samples * std::max(1.0, now / wanted)};
  for (NoiseAt at : last.noise) {
    at.noise *= s.noise_scale * times;
    if (at.noise <= wanted) return at;
  }
  NoiseAt most = last.noise.back();
  most.noise *= s.noise_scale * times;
  return most;
}

/// Finer radiosity and gather, whose samples start anew.
Way new_light(const Situation& s, std::span<const RoundFigures> rounds) {
  const RoundFigures& last = rounds.back();
  const float most = Settings::is_by_photons(last.integrator) ? kMostLevelOfPaths : kMostLevel;
  const double per_level = bias_per_level(rounds);
  Way way;
  if (is_unbiased(last) || s.bias <= 0 || last.level > most - 0.25F || per_level > kUseless) return way;
  const double wanted = std::log(kBiasOfNewLight * s.target / s.bias) / std::log(per_level);
  const float level = std::min(most, last.level + std::max(kLeastStep, static_cast<float>(wanted)));
  const double steps = static_cast<double>(level - last.level), times = std::pow(kWorkPerLevel, steps);
  const bool is_photons = Settings::is_by_photons(last.integrator);
  const NoiseAt at = noise_of_new_light(s, last, is_photons ? std::pow(kPathsNoisePerLevel, steps) : 1);
  const double samples = last.noise[0].samples > 0 ? at.samples / last.noise[0].samples : 1;
  const double light = last.light_work * (samples + kPreparation * times);
  way.mse = s.bias * std::pow(per_level, steps) + at.noise;
  const Audit audit = audit_for(s, last, way.mse, light);
  way.next = {Step::kNewLight, {}, round_after(last, audit.plan, at.scale), {level, false, 1}};
  way.work = light + audit.plan.paths() * s.path_work;
  way.is_enough = audit.tells;
  return way;
}

/// Path tracing alone: no bias, and as many paths as the audit's own say. Against bias alone.
Way by_paths(const Situation& s, const RoundsAsked& asked, const RoundFigures& last) {
  Way way;
  if (!asked.may_trace_paths || is_unbiased(last) || s.bias <= 0) return way;
  const double mean = square(last.accuracy->mean), variance = last.accuracy->path_variance / mean;
  way.mse = kMuchBias * s.target;
  const double light = last.pixels * variance / way.mse * s.path_work;
  const Audit audit = audit_for(s, last, way.mse, light);
  way.next = {Step::kNewLight, {}, round_after(last, audit.plan, 1), {last.level, true, 1}};
  way.work = light + audit.plan.paths() * s.path_work;
  way.is_enough = audit.tells;
  return way;
}

/// Enough goes before not enough, then less work; of what is not enough, the smaller error.
bool is_better(const Way& a, const Way& b) {
  if (a.is_enough != b.is_enough) return a.is_enough;
  return a.is_enough ? a.work < b.work : a.mse < b.mse;
}

NextRound stop(std::optional<bool> met) { return {Step::kStop, met, {}, {}}; }

NextRound next_for_error(const RoundsAsked& asked, std::span<const RoundFigures> rounds) {
  const RoundFigures& last = rounds.back();
  const bool is_black = last.accuracy && last.accuracy->audited_pixels > 0 && !last.accuracy->relative_rmse;
  if (is_black) return stop(std::nullopt);
  const bool is_met = last.accuracy && last.accuracy->surely_below && *last.accuracy->surely_below < asked.target.error;
  if (is_met || asked.rounds_left == 0) return stop(is_met);
  if (!last.accuracy || last.accuracy->audited_pixels == 0) {
    const AuditPlan plan = plan_audit({square(asked.target.error), 5, 1, 0.2 * square(asked.target.error), 1e5, last.pixels});
    return {Step::kMoreSamples, {}, round_after(last, plan, last.round.scale), {}};
  }
  const Situation s = situation_of(asked.target.error, rounds);
  std::vector<Way> ways = {more_samples(s, last), new_light(s, rounds)};
  // Paths are for what finer light cannot mend, or where they cost less.
  const Way paths = by_paths(s, asked, last);
  if (!std::isfinite(ways[1].mse) || paths.work <= ways[1].work) ways.push_back(paths);
  const Way& best = *std::min_element(ways.begin(), ways.end(), is_better);
  const bool is_worth_it = best.is_enough || best.mse < kWorthwhile * std::max(s.mse, s.noise_scale * last.noise[0].noise);
  return is_worth_it ? best.next : stop(false);
}

/// The most samples that fit into what is left, with an audit like the last one.
NextRound next_for_time(const RoundsAsked& asked, std::span<const RoundFigures> rounds) {
  const RoundFigures& last = rounds.back();
  const double cpu = last.light_cpu_seconds + last.audit_cpu_seconds;
  if (asked.rounds_left == 0 || !(cpu > 0) || !(last.noise[0].samples > 0)) return stop(std::nullopt);
  double light_wall = 0;  // of all samples under this light
  for (const RoundFigures& f : rounds) {
    const double all = f.light_cpu_seconds + f.audit_cpu_seconds;
    if (all > 0) light_wall += f.wall_seconds * f.light_cpu_seconds / all;
  }
  const double audit_wall = last.wall_seconds * last.audit_cpu_seconds / cpu;
  const double left = kShareOfLeft * (asked.seconds_left - asked.assembly_seconds) - audit_wall;
  NextRound next = stop(std::nullopt);
  for (const NoiseAt& at : last.noise) {
    const double growth = at.samples / last.noise[0].samples;
    if (growth < kLeastGrowth || (growth - 1) * light_wall > left) continue;
    next = {Step::kMoreSamples, {}, {last.round.number + 1, last.round.audit_pixels, last.round.audit_samples, at.scale}, {}};
  }
  return next;
}

double cpu_of(const RoundFigures& f) { return f.prepare_cpu_seconds + f.light_cpu_seconds + f.audit_cpu_seconds; }

/// CPU seconds of samples under the present light.
double light_cpu(std::span<const RoundFigures> rounds) {
  double sum = 0;
  for (std::size_t i = rounds.size(); i-- > 0;) {
    sum += rounds[i].light_cpu_seconds;
    if (rounds[i].kind != RoundFigures::Kind::kMoreSamples) break;
  }
  return sum;
}

/// CPU seconds of new samples that halve the error, where noise is all that is in the way.
std::optional<double> halving_by_samples(std::span<const RoundFigures> rounds) {
  const RoundFigures& last = rounds.back();
  const Situation s = situation_of(std::sqrt(std::max(last.accuracy->mse, 0.0)) / last.accuracy->mean / 2, rounds);
  for (const NoiseAt& at : last.noise) {
    if (s.bias + s.noise_scale * at.noise > s.target) continue;
    return light_cpu(rounds) * (at.samples / last.noise[0].samples - 1) + last.audit_cpu_seconds;
  }
  return std::nullopt;
}

}  // namespace

NextRound next_round(const RoundsAsked& asked, std::span<const RoundFigures> rounds) {
  if (asked.target.error > 0) return next_for_error(asked, rounds);
  if (asked.target.seconds > 0) return next_for_time(asked, rounds);
  return stop(std::nullopt);
}

std::optional<NextHalving> next_halving(std::span<const RoundFigures> rounds) {
  const RoundFigures& last = rounds.back();
  double cpu = 0, wall = 0, at_first = 0;
  for (const RoundFigures& f : rounds) {
    cpu += cpu_of(f);
    wall += f.prepare_wall_seconds + f.wall_seconds;
    if (at_first == 0) at_first = cpu;
  }
  if (!last.accuracy || !last.accuracy->rmse || !last.accuracy->rmse->value || !(cpu > 0)) return std::nullopt;
  NextHalving halving{3 * cpu, 0, "error going with the square root of the CPU time: one round tells no slope"};
  const std::optional<Accuracy>& first = rounds[0].accuracy;
  if (const std::optional<double> samples = halving_by_samples(rounds)) {
    halving = {*samples, 0, "the noise of the samples"};
  } else if (first && first->relative_rmse && first->relative_rmse->value && cpu > at_first) {
    const double gain = *first->relative_rmse->value / (*last.accuracy->rmse->value / last.accuracy->mean);
    const double slope = std::log(gain) / std::log(cpu / at_first);
    if (!(slope > kLeastSlope)) return std::nullopt;  // nothing that was tried has lowered it
    halving = {cpu * (std::exp2(1 / slope) - 1), 0, "the slope of error against CPU time over the rounds"};
  }
  halving.wall_seconds = halving.cpu_seconds * wall / cpu;
  return halving;
}

}  // namespace radfarm
