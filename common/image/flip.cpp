#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "image/rgb.h"
#include "math/spectrum.h"

namespace radfarm {
namespace {

// All constants are the paper's.
constexpr float kColorExponent = 0.7F, kColorKnee = 0.4F, kKneeValue = 0.95F;
constexpr float kFeatureWidth = 0.082F;  // degrees
constexpr float kFeatureExponent = 0.5F;
constexpr double kWidestScale = 0.04;    // of the Gaussians of contrast sensitivity: decides how far they reach
constexpr std::array<double, 3> kWhite = {0.950428545, 1.0, 1.088900371};  // D65

struct Gaussian {
  double amplitude, scale;
};

/// One number a pixel.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> v;
  float& at(int x, int y) { return v[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
  float at(int x, int y) const { return v[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
};
using Planes = std::array<Plane, 3>;
using Kernel = std::vector<double>;  // of odd size, about its middle

Plane plane_like(const Plane& p) { return {p.width, p.height, std::vector<float>(p.v.size())}; }

/// Borders are repeated.
Plane convolve(const Plane& in, const Kernel& along_x, const Kernel& along_y) {
  const auto pass = [](const Plane& from, const Kernel& kernel, bool is_x) {
    Plane to = plane_like(from);
    const int reach = static_cast<int>(kernel.size() / 2);
    for (int y = 0; y < from.height; ++y) {
      for (int x = 0; x < from.width; ++x) {
        double sum = 0;
        for (int k = -reach; k <= reach; ++k) {
          const int px = is_x ? std::clamp(x + k, 0, from.width - 1) : x, py = is_x ? y : std::clamp(y + k, 0, from.height - 1);
          sum += kernel[static_cast<std::size_t>(k + reach)] * static_cast<double>(from.at(px, py));
        }
        to.at(x, y) = static_cast<float>(sum);
      }
    }
    return to;
  };
  return pass(pass(in, along_x, true), along_y, false);
}

struct Xyz {
  double x, y, z;
};

Xyz xyz_of(const SpectrumD& c) {
  return {0.41238656 * c.r + 0.35759149 * c.g + 0.18045049 * c.b, 0.21263682 * c.r + 0.71518298 * c.g + 0.0721802 * c.b,
          0.01933062 * c.r + 0.11919716 * c.g + 0.95037259 * c.b};
}

SpectrumD rgb_of(const Xyz& c) {
  return {3.24100326 * c.x - 1.53739899 * c.y - 0.49861587 * c.z, -0.96922426 * c.x + 1.87592999 * c.y + 0.04155422 * c.z,
          0.05563942 * c.x - 0.2040112 * c.y + 1.05714897 * c.z};
}

/// Opponent colours that are linear in light: lightness, red against green, blue against yellow.
std::array<float, 3> opponent_of(const SpectrumD& rgb) {
  const Xyz c = xyz_of(rgb);
  const double x = c.x / kWhite[0], y = c.y / kWhite[1], z = c.z / kWhite[2];
  return {static_cast<float>(116 * y - 16), static_cast<float>(500 * (x - y)), static_cast<float>(200 * (y - z))};
}

SpectrumD rgb_of_opponent(float a, float rg, float by) {
  const double y = (static_cast<double>(a) + 16) / 116, x = y + static_cast<double>(rg) / 500, z = y - static_cast<double>(by) / 200;
  return rgb_of({x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

using Lab = std::array<double, 3>;

Lab lab_of(const SpectrumD& rgb) {
  const Xyz c = xyz_of(rgb);
  const auto curve = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double x = curve(c.x / kWhite[0]), y = curve(c.y / kWhite[1]), z = curve(c.z / kWhite[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// Colours of the dark are less colourful. [Hunt]
Lab adjusted(const Lab& lab) { return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]}; }

double hyab(const Lab& a, const Lab& b) { return std::fabs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

/// What a display shows of a layer, in linear light, [0, 1].
SpectrumD shown(const Spectrum& c, float scale) {
  const auto clamped = [&](float v) { return std::isnan(v) ? 0 : std::clamp(static_cast<double>(v * scale), 0.0, 1.0); };
  return {clamped(c.r), clamped(c.g), clamped(c.b)};
}

Planes opponent_planes(const Image& image, const RgbLayer& rgb, float scale) {
  Planes planes;
  for (Plane& p : planes) p = {image.width, image.height, std::vector<float>(image.pixel_count())};
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const auto color = opponent_of(shown(rgb.at(i), scale));
    for (std::size_t c = 0; c < 3; ++c) planes[c].v[i] = color[c];
  }
  return planes;
}

Kernel gaussian(double scale, int reach, double pixels_per_degree) {
  Kernel kernel;
  for (int k = -reach; k <= reach; ++k) {
    const double x = k / pixels_per_degree;
    kernel.push_back(std::exp(-std::numbers::pi * std::numbers::pi * x * x / scale));
  }
  return kernel;
}

/// What the eye resolves: each opponent channel by sums of Gaussians of total weight 1.
Plane seen(const Plane& plane, std::span<const Gaussian> parts, double pixels_per_degree) {
  const int reach = static_cast<int>(
      std::ceil(3 * std::sqrt(kWidestScale / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
  std::vector<Kernel> kernels;
  std::vector<double> weights;
  double total = 0;
  for (const Gaussian& part : parts) {
    kernels.push_back(gaussian(part.scale, reach, pixels_per_degree));
    const double sum = std::accumulate(kernels.back().begin(), kernels.back().end(), 0.0);
    weights.push_back(part.amplitude * std::sqrt(std::numbers::pi / part.scale));
    total += weights.back() * sum * sum;
  }
  Plane result = plane_like(plane);
  for (std::size_t i = 0; i < kernels.size(); ++i) {
    const Plane one = convolve(plane, kernels[i], kernels[i]);
    const auto weight = static_cast<float>(weights[i] / total);
    for (std::size_t p = 0; p < one.v.size(); ++p) result.v[p] += weight * one.v[p];
  }
  return result;
}

std::vector<Lab> seen_colors(const Planes& planes, double pixels_per_degree) {
  constexpr Gaussian kA[] = {{1, 0.0047}}, kRg[] = {{1, 0.0053}}, kBy[] = {{34.1, 0.04}, {13.5, 0.025}};
  const Plane a = seen(planes[0], kA, pixels_per_degree), rg = seen(planes[1], kRg, pixels_per_degree);
  const Plane by = seen(planes[2], kBy, pixels_per_degree);
  std::vector<Lab> colors;
  for (std::size_t i = 0; i < a.v.size(); ++i) {
    const SpectrumD rgb = rgb_of_opponent(a.v[i], rg.v[i], by.v[i]);
    colors.push_back(adjusted(lab_of({std::clamp(rgb.r, 0.0, 1.0), std::clamp(rgb.g, 0.0, 1.0), std::clamp(rgb.b, 0.0, 1.0)})));
  }
  return colors;
}

/// HyAB distances compressed to [0, 1]: small ones get most of the range.
float color_difference(const Lab& a, const Lab& b) {
  static const double most = std::pow(hyab(adjusted(lab_of({0, 1, 0})), adjusted(lab_of({0, 0, 1}))), static_cast<double>(kColorExponent));
  const double difference = std::pow(hyab(a, b), static_cast<double>(kColorExponent));
  const double knee = static_cast<double>(kColorKnee) * most;
  if (difference < knee) return static_cast<float>(static_cast<double>(kKneeValue) / knee * difference);
  return static_cast<float>(std::min(1.0, static_cast<double>(kKneeValue) +
                                              (difference - knee) / (most - knee) * (1 - static_cast<double>(kKneeValue))));
}

/// Positive weights add up to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
  double plus = 0, minus = 0;
  for (const double w : kernel) (w > 0 ? plus : minus) += w;
  for (double& w : kernel) w /= w > 0 ? plus : -minus;
  return kernel;
}

/// How strong edges and points are, by pixel.
struct Features {
  std::vector<float> edges, points;
};

Features features_of(const Plane& achromatic, double pixels_per_degree) {
  Plane normalised = achromatic;
  for (float& v : normalised.v) v = (v + 16) / 116;
  const double deviation = 0.5 * static_cast<double>(kFeatureWidth) * pixels_per_degree;
  const int reach = static_cast<int>(std::ceil(3 * deviation));
  Kernel blur, edge, point;
  for (int k = -reach; k <= reach; ++k) {
    const double g = std::exp(-k * k / (2 * deviation * deviation));
    blur.push_back(g), edge.push_back(-k * g), point.push_back((k * k / (deviation * deviation) - 1) * g);
  }
  const double sum = std::accumulate(blur.begin(), blur.end(), 0.0);
  for (double& w : blur) w /= sum;
  edge = balanced(edge), point = balanced(point);
  const auto strengths = [&](const Kernel& kernel) {
    const Plane x = convolve(normalised, kernel, blur), y = convolve(normalised, blur, kernel);
    std::vector<float> lengths;
    for (std::size_t i = 0; i < x.v.size(); ++i) lengths.push_back(std::hypot(x.v[i], y.v[i]));
    return lengths;
  };
  return {strengths(edge), strengths(point)};
}

}  // namespace

Result<FlipMap> flip(const Image& image, const Image& reference, float exposure_ev, float pixels_per_degree) {
  if (image.width != reference.width || image.height != reference.height) {
    return fail(Code::kInvalidArgument, "images differ in size");
  }
  RADFARM_TRY(const RgbLayer rgb, rgb_layer(image));
  RADFARM_TRY(const RgbLayer reference_rgb, rgb_layer(reference));
  const float scale = std::exp2(exposure_ev);
  const auto ppd = static_cast<double>(pixels_per_degree);
  const Planes a = opponent_planes(image, rgb, scale), b = opponent_planes(reference, reference_rgb, scale);
  const std::vector<Lab> colors_a = seen_colors(a, ppd), colors_b = seen_colors(b, ppd);
  const Features features_a = features_of(a[0], ppd), features_b = features_of(b[0], ppd);
  FlipMap map{image.width, image.height, {}, 0};
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const float feature = std::max(std::fabs(features_a.edges[i] - features_b.edges[i]),
                                   std::fabs(features_a.points[i] - features_b.points[i]));
    const float strengthened = std::min(1.0F, std::pow(feature / std::numbers::sqrt2_v<float>, kFeatureExponent));
    map.values.push_back(std::pow(color_difference(colors_a[i], colors_b[i]), 1 - strengthened));
    map.mean += static_cast<double>(map.values.back());
  }
  map.mean /= static_cast<double>(std::max<std::size_t>(1, map.values.size()));
  return map;
}

}  // namespace radfarm
