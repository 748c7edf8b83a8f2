#include "matter/ggx.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/sampling.h"

namespace radfarm {

float Ggx::distribution(const Vec3& h) const {
  if (!(h.z > 0)) return 0;
  const float x = h.x / alpha_x, y = h.y / alpha_y;
  const float sum = x * x + y * y + h.z * h.z;
  return 1 / (kPi * alpha_x * alpha_y * sum * sum);
}

float Ggx::lambda(const Vec3& w) const {
  const float z_squared = w.z * w.z;
  if (!(z_squared > 0)) return std::numeric_limits<float>::infinity();
  const float x = alpha_x * w.x, y = alpha_y * w.y;
  return (std::sqrt(1 + (x * x + y * y) / z_squared) - 1) / 2;
}

float Ggx::stretch(const Vec3& w) const {
  const float x = alpha_x * w.x, y = alpha_y * w.y;
  return std::sqrt(x * x + y * y + w.z * w.z);
}

Vec3 refract(const Vec3& o, const Vec3& h, float eta) {
  const float cosine = dot(o, h), sine_squared = std::max(0.0F, 1 - cosine * cosine) / (eta * eta);
  if (!(sine_squared < 1)) return {0, 0, 0};
  return normalize(h * (cosine / eta - std::sqrt(1 - sine_squared)) - o / eta);
}

Vec3 Ggx::sample_visible(const Vec3& o, const Vec2& u) const { return visible_facet(o, sample_uniform_disk(u)); }

Vec3 Ggx::visible_facet(const Vec3& o, const Vec2& disk) const {
  // Stretched so that the facets are a hemisphere; its projection along o is sampled.
  const Vec3 stretched = normalize(Vec3(alpha_x * o.x, alpha_y * o.y, o.z));
  const float squared = stretched.x * stretched.x + stretched.y * stretched.y;
  const Vec3 t1 = squared > 0 ? Vec3(-stretched.y, stretched.x, 0) / std::sqrt(squared) : Vec3(1, 0, 0);
  const Vec3 t2 = cross(stretched, t1);
  const float share = (1 + stretched.z) / 2;
  const float across = std::sqrt(std::max(0.0F, 1 - disk.x * disk.x));
  const float y = (1 - share) * across + share * disk.y;
  const float along = std::sqrt(std::max(0.0F, 1 - disk.x * disk.x - y * y));
  const Vec3 n = t1 * disk.x + t2 * y + stretched * along;
  return normalize(Vec3(alpha_x * n.x, alpha_y * n.y, std::max(1e-12F, n.z)));
}

float Ggx::pdf_visible(const Vec3& o, const Vec3& h) const {
  if (!(o.z > 0)) return 0;
  return 2 / (o.z + stretch(o)) * std::max(0.0F, dot(o, h)) * distribution(h);
}

}  // namespace radfarm
