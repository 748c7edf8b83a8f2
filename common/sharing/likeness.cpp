#include "sharing/likeness.h"

#include <algorithm>
#include <limits>

namespace radfarm {
namespace {

constexpr float kNormalTolerance = 0.25F;  // of unit normals, standard deviations of the weight
constexpr float kPlaneTolerance = 3;       // footprints off the tangent plane
constexpr float kLightTolerance = 0.7F;    // k of non-local means, in standard deviations of the difference
constexpr float kSameLight = 1e-6F;        // squared: light that differs by a thousandth is the same
constexpr float kFarthest = 8;             // exponents beyond weigh nothing

/// exp(-x), about, and 0 from kFarthest on: (1 - x / 8)^8.
inline float falloff(float x) {
  const float a = std::max(0.0F, 1 - x / kFarthest), b = a * a, c = b * b;
  return c * c;
}

}  // namespace

Likeness::Likeness(const Planes& planes, const PixelBlock& block) : planes_(planes), block_(block) {
  for (auto& row : frames_) row.resize(block.lanes());
  for (auto& row : features_) row.resize(block.lanes());
  surface_.resize(block.lanes());
  const auto padded = [](int side) { return static_cast<std::size_t>(side + 2 * kPatchRadius); };
  const std::size_t about = padded(block.width()) * padded(block.height());
  for (auto* row : {&distance_, &counts_, &along_, &counts_along_}) row->resize(about);
  std::size_t lane = 0;
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x, ++lane) {
      const std::size_t at = planes.index(x, y);
      const Frame frame(Vec3(planes.normal[0][at], planes.normal[1][at], planes.normal[2][at]));
      for (int k = 0; k < 3; ++k) {
        frames_[k][lane] = frame.tangent[k];
        frames_[3 + k][lane] = frame.bitangent[k];
        frames_[6 + k][lane] = frame.normal[k];
      }
    }
  }
}

void Likeness::move_to(int dx, int dy) {
  dx_ = dx, dy_ = dy;
  const auto n = static_cast<std::size_t>(block_.width());
  for (int y = block_.y0; y < block_.y1; ++y) {
    const std::size_t here = planes_.index(block_.x0, y), there = planes_.index(block_.x0 + dx, y + dy);
    const std::size_t first = static_cast<std::size_t>(y - block_.y0) * n;
    for (std::size_t i = 0; i < n; ++i) {
      std::array<float, 3> dp, dn;
      for (int k = 0; k < 3; ++k) {
        dp[k] = planes_.position[k][there + i] - planes_.position[k][here + i];
        dn[k] = planes_.normal[k][there + i] - planes_.normal[k][here + i];
      }
      const auto along = [&](int axis, const std::array<float, 3>& d) {
        return d[0] * frames_[axis][first + i] + d[1] * frames_[axis + 1][first + i] + d[2] * frames_[axis + 2][first + i];
      };
      const float footprint = planes_.footprint[here + i];
      const float off = along(6, dp) / (kPlaneTolerance * footprint);
      const float bent = (dn[0] * dn[0] + dn[1] * dn[1] + dn[2] * dn[2]) / (kNormalTolerance * kNormalTolerance);
      const bool both = planes_.shares[here + i] * planes_.shares[there + i] > 0;
      surface_[first + i] = both ? (bent + off * off) / 2 : kFarthest;
      const float scale = both ? 1 / (kShareRadius * footprint) : 0;
      features_[0][first + i] = along(0, dp) * scale;
      features_[1][first + i] = along(3, dp) * scale;
      features_[2][first + i] = both ? along(0, dn) / kNormalTolerance : 0;
      features_[3][first + i] = both ? along(3, dn) / kNormalTolerance : 0;
    }
  }
}

void Likeness::compare_light(const Planes::Part& part, int half) {
  const Plane& light = part.luminance[half];
  const auto wide = static_cast<std::size_t>(block_.width() + 2 * kPatchRadius);
  std::size_t row = 0;
  for (int y = block_.y0 - kPatchRadius; y < block_.y1 + kPatchRadius; ++y, row += wide) {
    const std::size_t here = planes_.index(block_.x0 - kPatchRadius, y);
    const std::size_t there = planes_.index(block_.x0 - kPatchRadius + dx_, y + dy_);
    for (std::size_t i = 0; i < wide; ++i) {
      const float a = light[here + i], b = light[there + i], va = part.variance[here + i], vb = part.variance[there + i];
      const float noise = kLightTolerance * kLightTolerance * (va + vb) + kSameLight * (a * a + b * b);
      const float count = planes_.shares[here + i] * planes_.shares[there + i];
      const float apart = (a - b) * (a - b) - (va + std::min(va, vb));
      counts_[row + i] = count;
      distance_[row + i] = noise > 0 ? count * apart / noise : 0;
    }
    // Sums along the row, then, in weigh(), across.
    for (std::size_t i = kPatchRadius; i + kPatchRadius < wide; ++i) {
      float sum = 0, count = 0;
      for (std::size_t k = i - kPatchRadius; k <= i + kPatchRadius; ++k) sum += distance_[row + k], count += counts_[row + k];
      along_[row + i] = sum, counts_along_[row + i] = count;
    }
  }
}

void Likeness::weigh(const Planes::Part& part, int half, std::vector<float>& weights) {
  compare_light(part, half);
  const auto n = static_cast<std::size_t>(block_.width()), wide = n + 2 * kPatchRadius;
  for (std::size_t y = 0; y < static_cast<std::size_t>(block_.height()); ++y) {
    for (std::size_t i = 0; i < n; ++i) {
      float sum = 0, count = 0;
      for (std::size_t k = 0; k <= 2 * kPatchRadius; ++k) {
        sum += along_[(y + k) * wide + i + kPatchRadius];
        count += counts_along_[(y + k) * wide + i + kPatchRadius];
      }
      const float light = count > 0 ? std::max(0.0F, sum / count) : 0;
      weights[y * n + i] = falloff(surface_[y * n + i] + light);
    }
  }
}

}  // namespace radfarm
