#include "scene/texture_pyramid.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "scene/texture.h"

namespace radfarm {
namespace {

constexpr int kMaxProbes = 16;  // along a footprint
// Where nothing is covered, colours still have a mean.
constexpr float kLeastWeight = 0x1p-12F;
constexpr float kFullCode = 65535;

/// Which texels of a row of `from` one of a row of `to` covers, and how much of it each is.
struct Share {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::array<float, 4> weight{};  // a third of a row of 7 reaches into four
};

Share share_of(std::uint32_t i, std::uint32_t from, std::uint32_t to) {
  const double scale = static_cast<double>(from) / to, begin = i * scale, end = (i + 1) * scale;
  Share share{static_cast<std::uint32_t>(begin), 0, {}};
  for (std::uint32_t k = share.first; k < from && k < end && share.count < share.weight.size(); ++k) {
    share.weight[share.count++] = static_cast<float>((std::min(end, k + 1.0) - std::max(begin, 1.0 * k)) / scale);
  }
  return share;
}

/// A level before it is coded: its alpha channel is the weight its colours were multiplied by, where they count by alpha.
struct Plane {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Vec4> texels;
};

template <typename Fetch>
Plane halve(std::uint32_t width, std::uint32_t height, const Fetch& fetch) {
  Plane half{std::max(1U, width / 2), std::max(1U, height / 2), {}};
  half.texels.resize(std::size_t{half.width} * half.height, Vec4(0, 0, 0, 0));
  parallel_for(half.height, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const Share down = share_of(static_cast<std::uint32_t>(row), height, half.height);
      for (std::uint32_t x = 0; x < half.width; ++x) {
        const Share right = share_of(x, width, half.width);
        Vec4& sum = half.texels[row * half.width + x];
        for (std::uint32_t j = 0; j < down.count; ++j) {
          for (std::uint32_t i = 0; i < right.count; ++i) {
            sum += fetch(right.first + i, down.first + j) * (down.weight[j] * right.weight[i]);
          }
        }
      }
    }
  });
  return half;
}

Vec4 weighed(const Vec4& texel) {
  const float weight = texel.w + kLeastWeight;
  return {texel.x * weight, texel.y * weight, texel.z * weight, weight};
}

Vec4 unweighed(const Vec4& texel) {
  return {texel.x / texel.w, texel.y / texel.w, texel.z / texel.w, std::max(0.0F, texel.w - kLeastWeight)};
}

std::uint16_t to_code(float value) { return static_cast<std::uint16_t>(std::clamp(value, 0.0F, 1.0F) * kFullCode + 0.5F); }

TexturePyramid::Level coded(const Plane& plane, ColorWeight weight) {
  TexturePyramid::Level level{plane.width, plane.height, {}};
  level.texels.reserve(plane.texels.size());
  for (const Vec4& stored : plane.texels) {
    const Vec4 texel = weight == ColorWeight::kAlpha ? unweighed(stored) : stored;
    level.texels.push_back({to_code(texel.x), to_code(texel.y), to_code(texel.z), to_code(texel.w)});
  }
  return level;
}

Vec4 look_up_level(const Texture& texture, const TexturePyramid& pyramid, std::size_t level, const Vec2& uv) {
  if (level == 0) return texture_lookup(texture, uv);
  const TexturePyramid::Level& coarse = pyramid.levels[level - 1];
  const auto fetch = [&](std::uint32_t x, std::uint32_t y) {
    const auto& code = coarse.texels[std::size_t{y} * coarse.width + x];
    return Vec4(code[0], code[1], code[2], code[3]) * (1 / kFullCode);
  };
  return bilinear(coarse.width, coarse.height, texture.wrap_u, texture.wrap_v, uv, fetch);
}

/// Between which levels' texels a width lies, in texels of the texture.
struct Between {
  std::size_t fine = 0;
  float coarse_share = 0;  // of the next one
};

Between levels_of(float width, std::size_t count) {
  const float level = std::min(std::log2(width), static_cast<float>(count));
  const float whole = std::floor(level);
  return {static_cast<std::size_t>(whole), level - whole};
}

Vec4 trilinear(const Texture& texture, const TexturePyramid& pyramid, const Between& levels, const Vec2& uv) {
  const Vec4 fine = look_up_level(texture, pyramid, levels.fine, uv);
  if (levels.coarse_share == 0) return fine;
  return fine * (1 - levels.coarse_share) + look_up_level(texture, pyramid, levels.fine + 1, uv) * levels.coarse_share;
}

}  // namespace

std::size_t TexturePyramid::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels) sum += level.texels.size() * sizeof(level.texels[0]);
  return sum;
}

TexturePyramid make_pyramid(const Texture& texture, ColorWeight weight) {
  TexturePyramid pyramid;
  Plane plane;
  std::uint32_t width = texture.width, height = texture.height;
  while (width > 1 || height > 1) {
    if (pyramid.levels.empty()) {
      plane = halve(width, height, [&](std::uint32_t x, std::uint32_t y) {
        const Vec4 texel = texel_at(texture, x, y);
        return weight == ColorWeight::kAlpha ? weighed(texel) : texel;
      });
    } else {
      plane = halve(width, height, [&](std::uint32_t x, std::uint32_t y) { return plane.texels[std::size_t{y} * width + x]; });
    }
    pyramid.levels.push_back(coded(plane, weight));
    width = plane.width, height = plane.height;
  }
  return pyramid;
}

Vec4 filtered_lookup(const Texture& texture, const TexturePyramid& pyramid, const Vec2& uv, const UvFootprint& footprint) {
  const auto in_texels = [&](const Vec2& v) {
    return Vec2(v.x * static_cast<float>(texture.width), v.y * static_cast<float>(texture.height)).length();
  };
  const float along = in_texels(footprint.along), across = in_texels(footprint.across);
  const Vec2 axis = along >= across ? footprint.along : footprint.across;
  const float longest = std::max(along, across);
  if (!(longest > 1) || pyramid.levels.empty()) return texture_lookup(texture, uv);
  const float area = std::fabs(footprint.along.cross(footprint.across)) * static_cast<float>(texture.width) *
                     static_cast<float>(texture.height);
  if (!std::isfinite(area / longest)) return look_up_level(texture, pyramid, pyramid.levels.size(), uv);
  const float width = std::max(1.0F, area / longest);
  const int probes = static_cast<int>(std::min(std::ceil(longest / width), static_cast<float>(kMaxProbes)));
  const float spanned = std::min(1.0F, kMaxProbes * width / longest);
  const Between levels = levels_of(width, pyramid.levels.size());
  Vec4 sum(0, 0, 0, 0);
  for (int i = 0; i < probes; ++i) {
    const float place = (static_cast<float>(i) + 0.5F) / static_cast<float>(probes) - 0.5F;
    sum += trilinear(texture, pyramid, levels, uv + axis * (spanned * place));
  }
  return sum / static_cast<float>(probes);
}

}  // namespace radfarm
