#include "frame/audit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "estimate/audit_pixels.h"
#include "frame/tasks.h"

namespace radfarm {
namespace {

constexpr int kResamples = 1000;
constexpr double kRisk = 0.05;  // that a job stops although its error is above the target, over all rounds
constexpr std::uint64_t kBootstrapKey = 0x626f6f74;  // "boot"

/// What one audited pixel contributes.
struct Term {
  double weight = 0;    // share of the image
  double product = 0;   // (x - r1)(x - r2), luminance
  double shift = 0;     // (r1 + r2) / 2 - x
  double noise = 0;     // variance of `product` by that of r1 and r2 alone
};

SpectrumD mean(const SpectrumD& sum, const PixelSums& p) { return sum / static_cast<double>(p.samples); }
SpectrumD mean_reflected(const PixelSums& p) { return mean(p.reflected(), p); }

double mean_of_image(const Raster& raster) {
  double sum = 0;
  for (const PixelSums& p : raster.pixels) sum += luminance(mean_reflected(p));
  return sum / static_cast<double>(raster.pixels.size());
}

struct Moments {
  double mse = 0;
  double mean = 0;
};

Moments weigh(std::span<const Term> terms, double image_mean, RandomSequence* random) {
  double weight = 0, product = 0, shift = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto pick = static_cast<std::size_t>(random == nullptr ? static_cast<double>(i)
                                                                 : random->uniform_double() * static_cast<double>(terms.size()));
    weight += terms[pick].weight;
    product += terms[pick].weight * terms[pick].product;
    shift += terms[pick].weight * terms[pick].shift;
  }
  return {product / weight, image_mean + shift / weight};
}

double root(double mse) { return std::sqrt(std::max(mse, 0.0)); }

MeasuredError measured(double value, std::vector<double> resampled) {
  std::sort(resampled.begin(), resampled.end());
  MeasuredError error;
  error.lower = resampled[static_cast<std::size_t>(0.025 * kResamples)];
  error.upper = resampled[static_cast<std::size_t>(0.975 * kResamples)];
  if (value > 0) error.value = value;
  return error;
}

/// What of the squared error's uncertainty is the audit's own, and what a single path varies.
void add_uncertainty(std::span<const Term> terms, Accuracy& accuracy) {
  double weight = 0, squares = 0, noise = 0;
  for (const Term& term : terms) weight += term.weight;
  for (const Term& term : terms) {
    const double share = term.weight / weight, off = term.product - accuracy.mse;
    squares += share * share * off * off;
    noise += share * share * term.noise;
  }
  accuracy.mse_error = std::sqrt(squares);
  accuracy.audit_noise = std::sqrt(std::min(noise, squares));
}

/// Sample variance of an estimate's mean; of one sample there is none.
double variance(const PixelSums& p) { return p.samples < 2 ? 0 : variance_of_mean(p); }

void add_parts(const PixelSums& x, const AuditResult::Pixel& r, double weight, Accuracy& accuracy) {
  const SpectrumD reflected = mean_reflected(x);
  const SpectrumD rest1 = reflected - mean_reflected(r.first);
  const SpectrumD rest2 = reflected - mean_reflected(r.second);
  const auto part_mse = [&](const SpectrumD& of_x, const SpectrumD& of_first) {
    return weight * luminance(mean(of_x, x) - mean(of_first, r.first)) * luminance(rest2);
  };
  accuracy.direct_mse += part_mse(x.direct, r.first.direct);
  accuracy.indirect_mse += part_mse(x.indirect, r.first.indirect);
  accuracy.specular_mse += part_mse(x.specular, r.first.specular);
  accuracy.channel_mse[0] += weight * rest1.r * rest2.r;
  accuracy.channel_mse[1] += weight * rest1.g * rest2.g;
  accuracy.channel_mse[2] += weight * rest1.b * rest2.b;
}

std::size_t part_of_map(const Settings& settings, int x, int y) {
  const int column = x * Accuracy::kMapColumns / settings.width, row = y * Accuracy::kMapRows / settings.height;
  return static_cast<std::size_t>(row * Accuracy::kMapColumns + column);
}

struct Audited {
  const Settings& settings;
  const Round& round;
  const Raster& raster;
};

Result<std::vector<Term>> compare_pixels(const Audited& of, std::span<const AuditResult> audits, Accuracy& accuracy) {
  const std::vector<AuditPixel> chosen = audited_pixels(of.settings, of.round);
  std::vector<Term> terms;
  for (const AuditResult& audited : audits) {
    for (const AuditResult::Pixel& r : audited.pixels) {
      const bool is_expected = terms.size() < chosen.size() && chosen[terms.size()].x == r.x &&
                               chosen[terms.size()].y == r.y && r.first.samples > 0 && r.second.samples > 0;
      if (!is_expected) return fail(Code::kDataLoss, "an audit result does not fit its task");
      const double weight = chosen[terms.size()].weight;
      const PixelSums& x = of.raster.pixels[static_cast<std::size_t>(r.y) * static_cast<std::size_t>(of.settings.width) +
                                            static_cast<std::size_t>(r.x)];
      const double value = luminance(mean_reflected(x));
      const double r1 = luminance(mean_reflected(r.first));
      const double r2 = luminance(mean_reflected(r.second));
      const double v1 = variance(r.first), v2 = variance(r.second);
      terms.push_back({weight, (value - r1) * (value - r2), (r1 + r2) / 2 - value, v1 * v2});
      accuracy.path_variance += weight * (v1 * r.first.samples + v2 * r.second.samples) / 2;
      add_parts(x, r, weight, accuracy);
      accuracy.map_mse[part_of_map(of.settings, r.x, r.y)] += weight * terms.back().product;
    }
  }
  if (terms.size() != chosen.size()) return fail(Code::kDataLoss, "audit results are missing");
  return terms;
}

}  // namespace

Result<Accuracy> audit(const Settings& settings, const Round& round, const Raster& raster, std::span<const AuditResult> audits) {
  Accuracy accuracy;
  const double image_mean = mean_of_image(raster);
  accuracy.mean = image_mean;
  RADFARM_TRY(const std::vector<Term> terms, compare_pixels({settings, round, raster}, audits, accuracy));
  if (terms.empty()) return accuracy;
  accuracy.audited_pixels = static_cast<std::uint32_t>(terms.size());
  const Moments measured_here = weigh(terms, image_mean, nullptr);
  accuracy.mean = measured_here.mean;
  accuracy.mse = measured_here.mse;
  add_uncertainty(terms, accuracy);
  if (!(measured_here.mean > 0)) return accuracy;

  std::vector<double> absolute, relative;
  for (std::uint64_t i = 0; i < kResamples; ++i) {
    RandomSequence random(combine(audit_seed(settings, round), kBootstrapKey, i));
    const Moments m = weigh(terms, image_mean, &random);
    absolute.push_back(root(m.mse));
    relative.push_back(m.mean > 0 ? root(m.mse) / m.mean : 0);
  }
  const double rmse = root(measured_here.mse);
  accuracy.rmse = measured(rmse, absolute);
  accuracy.relative_rmse = measured(rmse / measured_here.mean, relative);
  std::sort(relative.begin(), relative.end());
  accuracy.surely_below = relative[static_cast<std::size_t>((1 - kRisk / kMostRounds) * kResamples)];
  return accuracy;
}

}  // namespace radfarm
