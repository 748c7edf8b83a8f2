#include "sharing/share_light.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/random.h"
#include "math/statistics.h"

namespace radfarm {
namespace {

constexpr int kSide = 48;
constexpr std::uint32_t kSamples = 8;
constexpr int kRadius = 8;  // farther than pixels share

/// What one pixel sees: a surface, and light as irradiance / pi.
struct Seen {
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 1};
  float albedo = 0.5F;
  double light = 1;
  float emission = 0;
};
using View = std::function<Seen(int x, int y)>;

Seen plane(int x, int y) { return {Vec3(0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y), 0), {0, 0, 1}, 0.5F, 1, 0}; }

struct Picture {
  std::vector<PixelSums> pixels;
  std::vector<SharingSums> sums;
  double direct(int x, int y) const { return mean(pixels[at(x, y)].direct.g, x, y); }
  double indirect(int x, int y) const { return mean(pixels[at(x, y)].indirect.g, x, y); }
  static std::size_t at(int x, int y) { return static_cast<std::size_t>(y * kSide + x); }

 private:
  double mean(double sum, int x, int y) const { return sum / pixels[at(x, y)].samples; }
};

/// `noise`: a sample is so many times its mean, evenly from 1 - noise to 1 + noise.
Picture paint(const View& view, double noise, std::uint64_t seed = 1) {
  Picture picture;
  RandomSequence random(seed);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const Seen seen = view(x, y);
      PixelSums& pixel = picture.pixels.emplace_back();
      SharingSums& sums = picture.sums.emplace_back();
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        const auto sample = [&] { return seen.light * (1 + noise * (2 * random.uniform_double() - 1)); };
        const Spectrum direct(seen.albedo * static_cast<float>(sample())), indirect(seen.albedo * static_cast<float>(sample()));
        const RadianceParts parts{Spectrum(seen.emission), direct, indirect, Spectrum(0.25F)};
        pixel.add(parts);
        sums.add(i % 2 == 1, parts, {true, seen.position, seen.normal, Spectrum(seen.albedo), {}, kNone, kNone, {}});
      }
    }
  }
  return picture;
}

Picture shared(Picture picture) {
  share_light(kSide, kSide, picture.sums, picture.pixels);
  return picture;
}

/// Mean and mean square of how far direct light is off what the view has, borders left out.
struct Off {
  RunningStatistics error, square;
};
Off off(const Picture& picture, const View& view, int border = 0) {
  Off found;
  for (int y = border; y < kSide - border; ++y) {
    for (int x = border; x < kSide - border; ++x) {
      const Seen seen = view(x, y);
      const double e = picture.direct(x, y) - static_cast<double>(seen.albedo) * seen.light;
      found.error.add(e);
      found.square.add(e * e);
    }
  }
  return found;
}

TEST(ShareLight, NoiseFallsWhereTheSurfaceIsSmooth) {
  const Picture raw = paint(plane, 0.8), better = shared(raw);
  EXPECT_LT(off(better, plane).square.mean(), off(raw, plane).square.mean() / 20);
  // What is left is alike over some kRadius^2 pixels. One false alarm in 16000.
  EXPECT_NEAR(off(better, plane).error.mean(), 0, 4 * kRadius * off(better, plane).error.standard_error());
}

TEST(ShareLight, GradientsStay) {
  const View view = [](int x, int y) {
    Seen seen = plane(x, y);
    seen.light = 1 + 0.02 * x + 0.01 * y;
    return seen;
  };
  const Picture raw = paint(view, 0.5), better = shared(raw);
  EXPECT_LT(off(better, view).square.mean(), off(raw, view).square.mean() / 15);
  // At the image's border, too, where neighbours are on one side.
  for (int y = 0; y < kSide; ++y) EXPECT_NEAR(better.direct(kSide - 1, y), 0.5 * view(kSide - 1, y).light, 0.12) << y;
}

TEST(ShareLight, TexturesStay) {
  const View view = [](int x, int y) {
    Seen seen = plane(x, y);
    seen.albedo = (x + y) % 2 == 0 ? 0.8F : 0.2F;
    return seen;
  };
  const Picture raw = paint(view, 0.5);
  EXPECT_LT(off(shared(raw), view).square.mean(), off(raw, view).square.mean() / 15);
}

/// Two walls that meet, lit differently: light of one must not be found on the other.
TEST(ShareLight, FoldsDivide) {
  const View view = [](int x, int y) {
    Seen seen = plane(x, y);
    const auto away = 0.1F * static_cast<float>(x - kSide / 2);
    if (x >= kSide / 2) seen.position = Vec3(0.1F * kSide / 2, seen.position.y, away), seen.normal = Vec3(-1, 0, 0), seen.light = 4;
    return seen;
  };
  const Picture raw = paint(view, 0.8), better = shared(raw);
  EXPECT_LT(off(better, view).square.mean(), off(raw, view).square.mean() / 15);
}

/// A shadow's edge on one wall: nothing but its light tells.
TEST(ShareLight, EdgesOfLightStayAsNoiseGoes) {
  const View view = [](int x, int y) {
    Seen seen = plane(x, y);
    seen.light = x < kSide / 2 ? 1 : 0.2;
    return seen;
  };
  double before = 1;
  for (const double noise : {0.8, 0.2, 0.05}) {
    const double square = off(shared(paint(view, noise)), view).square.mean();
    EXPECT_LT(square, before / 8) << noise;  // noise squared falls by 16 a step
    before = square;
  }
  EXPECT_LT(std::sqrt(before), 0.002);
}

TEST(ShareLight, WithoutNoiseNothingChanges) {
  const View view = [](int x, int y) {
    Seen seen = plane(x, y);
    seen.light = 1 + std::sin(0.5 * x) * std::cos(0.3 * y);
    return seen;
  };
  const Picture raw = paint(view, 0), better = shared(raw);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) EXPECT_NEAR(better.direct(x, y), raw.direct(x, y), 0.01) << x << ' ' << y;
  }
}

TEST(ShareLight, SpecularLightAndPixelsThatSeeEmittersStay) {
  const View view = [](int x, int y) {
    Seen seen = plane(x, y);
    seen.emission = x == 20 ? 3.0F : 0.0F;
    return seen;
  };
  const Picture raw = paint(view, 0.8), better = shared(raw);
  for (std::size_t i = 0; i < raw.pixels.size(); ++i) {
    EXPECT_EQ(better.pixels[i].specular, raw.pixels[i].specular);
    EXPECT_EQ(better.pixels[i].emission, raw.pixels[i].emission);
  }
  for (int y = 0; y < kSide; ++y) EXPECT_EQ(better.pixels[Picture::at(20, y)], raw.pixels[Picture::at(20, y)]);
}

TEST(ShareLight, IrradianceFollows) {
  Picture picture = paint(plane, 0.8);
  std::vector<AovSums> aovs(picture.pixels.size());
  for (std::size_t i = 0; i < aovs.size(); ++i) {
    aovs[i].hits = kSamples;
    aovs[i].irradiance = (picture.pixels[i].direct + picture.pixels[i].indirect) * (std::numbers::pi / 0.5);
  }
  share_light(kSide, kSide, picture.sums, picture.pixels, aovs);
  for (std::size_t i = 0; i < aovs.size(); ++i) {
    const double reflected = picture.pixels[i].direct.g + picture.pixels[i].indirect.g;
    EXPECT_NEAR(aovs[i].irradiance.g, reflected * std::numbers::pi / 0.5, 1e-5 * reflected);
  }
}

TEST(ShareLight, PixelsWithoutLightOrSurfaceAreLeftAlone) {
  Picture dark = paint(plane, 0);
  for (PixelSums& p : dark.pixels) p.direct = p.indirect = {};
  for (SharingSums& s : dark.sums) s.direct = s.indirect = {};
  for (const PixelSums& p : shared(dark).pixels) EXPECT_EQ(p.direct, SpectrumD());
  Picture nothing = paint(plane, 0.5);
  for (SharingSums& s : nothing.sums) s = {};
  const Picture same = shared(nothing);
  EXPECT_EQ(same.pixels, nothing.pixels);
}

TEST(ShareLight, TheSameBitsOnAnyNumberOfThreads) {
  const Picture raw = paint(plane, 0.8);
  const Picture many = shared(raw);
  const ThreadLimit limit(1);
  EXPECT_EQ(shared(raw).pixels, many.pixels);
}

}  // namespace
}  // namespace radfarm
