#include "support/closed_scenes.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "support/closed_forms.h"
#include "support/dense_radiosity.h"
#include "support/shapes.h"
#include "support/small_scenes.h"

namespace radfarm::test {
namespace {

constexpr std::uint32_t kSender = 0;    // materials, in the order in which the scenes below make them
constexpr std::uint32_t kReceiver = 1;
constexpr float kSenderReflects = 0.8F;
// The receiver must reflect a little to be counted; what comes back of that is left out of `truth`.
constexpr float kReceiverReflects = 1e-3F;

std::string text(const char* format, double a, double b, double c) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

float exitance_of(double lux) { return static_cast<float>(lux / std::numbers::pi); }

/// Materials of a pair: the sender emits 1 lm/m^2, or reflects what a light along `way` gives it, 1 lux.
SceneMaker pair_of(Sent sent, const Vec3d& way) {
  SceneMaker maker;
  const bool emits = sent == Sent::kEmitted;
  maker.material(Spectrum(emits ? 0.0F : kSenderReflects), Spectrum(emits ? exitance_of(1) : 0.0F));
  maker.material(Spectrum(kReceiverReflects));
  if (emits) return maker;
  PunctualLight light;
  light.kind = PunctualLight::Kind::kDirectional;
  light.direction = to_float(normalize(way));
  light.intensity = Spectrum(static_cast<float>(-1 / normalize(way).y));
  maker.light(light);
  return maker;
}

/// Slanted so that it reaches all of a sender that is `width` wide below a receiver `gap` above.
Vec3d slanted(double width, double gap) { return {1, -gap / (2 * width), 0}; }

ClosedForm form_factor_of(std::string form, std::string name, SceneMaker& maker, Sent sent, double factor) {
  ClosedForm c;
  c.form = std::move(form);
  const bool emits = sent == Sent::kEmitted;
  c.name = std::move(name) + (emits ? ", emitted" : ", reflected");
  c.scene = maker.take();
  c.closed_form = c.truth = factor;
  c.truth_error = emits ? 0 : static_cast<double>(kSenderReflects * kReceiverReflects);
  c.answer = [emits](const World& world, const RadiositySolution& solution) {
    double received = 0, area = 0;
    for (const std::uint32_t leaf : solution.hierarchy.leaves) {
      const Node& node = solution.hierarchy.nodes[leaf];
      const Patch& patch = solution.hierarchy.patches[node.patch];
      const std::uint32_t material = world.scene.meshes[world.scene.instances[patch.instance].mesh].material;
      if (patch.is_front == 0) continue;
      if (material == kSender) area += static_cast<double>(node.area);
      if (material == kReceiver) received += static_cast<double>(luminance(solution.reflected_power[leaf]));
    }
    return received / static_cast<double>(kReceiverReflects) / (area * (emits ? 1 : static_cast<double>(kSenderReflects)));
  };
  return c;
}

std::vector<DenseElement> elements_of(const Shape& shape, double reflectance, double exitance) {
  std::vector<DenseElement> elements;
  for (const auto& t : shape.triangles) {
    elements.push_back({{to_double(shape.positions[t[0]]), to_double(shape.positions[t[1]]), to_double(shape.positions[t[2]])},
                        reflectance, exitance});
  }
  return elements;
}

void append(std::vector<DenseElement>& all, const std::vector<DenseElement>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// A rectangle in cells x cells equal parts.
std::vector<DenseElement> cells_of(const std::vector<Vec3d>& r, int cells, double reflectance, double exitance) {
  std::vector<DenseElement> elements;
  const Vec3d u = (r[1] - r[0]) / cells, v = (r[3] - r[0]) / cells;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const Vec3d p = r[0] + u * i + v * j;
      elements.push_back({{p, p + u, p + u + v, p + v}, reflectance, exitance});
    }
  }
  return elements;
}

/// Mean over the elements from `first` on, by area.
double mean(const std::vector<DenseElement>& elements, const std::vector<double>& b, std::size_t first, std::size_t count) {
  double sum = 0, area = 0;
  for (std::size_t i = first; i < first + count; ++i) sum += b[i] * area_of(elements[i]), area += area_of(elements[i]);
  return sum / area;
}

/// A truth by numbers: what a coarser solution differs by is more than its error.
void set_truth(ClosedForm& c, double fine, double coarse) {
  c.truth = fine;
  c.truth_error = std::fabs(coarse / fine - 1);
}

std::function<double(const World&, const RadiositySolution&)> exitance_answer(std::uint32_t material) {
  return [material](const World& w, const RadiositySolution& s) { return reflected_exitance(w, s, material); };
}

std::function<double(const World&, const RadiositySolution&)> unevenness_about(double expected) {
  return [expected](const World&, const RadiositySolution& solution) {
    double squares = 0, area = 0;
    for (const std::uint32_t leaf : solution.hierarchy.leaves) {
      const auto size = static_cast<double>(solution.hierarchy.nodes[leaf].area);
      const double deviation = luminance(SpectrumD(solution.reflected_power[leaf])) / size / expected - 1;
      squares += size * deviation * deviation, area += size;
    }
    return std::sqrt(squares / area);
  };
}

const char* const kFurnaceNames[] = {"box", "sphere", "cluttered box"};

}  // namespace

double reflected_exitance(const World& world, const RadiositySolution& solution, std::uint32_t material) {
  double power = 0, area = 0;
  for (const std::uint32_t leaf : solution.hierarchy.leaves) {
    const Node& node = solution.hierarchy.nodes[leaf];
    const Patch& patch = solution.hierarchy.patches[node.patch];
    if (patch.is_front == 0 || world.scene.meshes[world.scene.instances[patch.instance].mesh].material != material) continue;
    power += luminance(SpectrumD(solution.reflected_power[leaf]));
    area += static_cast<double>(node.area);
  }
  return area > 0 ? power / area : 0;
}

ClosedForm parallel_plates(double a, double b, double gap, Sent sent) {
  SceneMaker maker = pair_of(sent, slanted(a, gap));
  const auto x = static_cast<float>(a), z = static_cast<float>(b), y = static_cast<float>(gap);
  maker.polygon(kSender, {{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}});
  maker.polygon(kReceiver, {{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}});
  return form_factor_of("O1", text("%g x %g, gap %g", a, b, gap), maker, sent, parallel_rectangles(a, b, gap));
}

ClosedForm corner(double width, double height, double edge, Sent sent) {
  SceneMaker maker = pair_of(sent, {0, -1, 0});
  const auto x = static_cast<float>(width), y = static_cast<float>(height), z = static_cast<float>(edge);
  maker.polygon(kSender, {{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}});
  maker.polygon(kReceiver, {{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}});
  return form_factor_of("O2", text("w %g, h %g, l %g", width, height, edge), maker, sent,
                        perpendicular_rectangles(width, height, edge));
}

ClosedForm discs(double r1, double r2, double gap, Sent sent) {
  constexpr std::uint32_t kCorners = 32;
  SceneMaker maker = pair_of(sent, slanted(r1 + r2, gap));
  const Shape below = disc(r1, 0, kCorners), above = disc(r2, gap, kCorners).reversed();
  maker.mesh(kSender, below.positions, below.triangles);
  maker.mesh(kReceiver, above.positions, above.triangles);
  ClosedForm c = form_factor_of("O3", text("r %g and %g, gap %g", r1, r2, gap), maker, sent, coaxial_discs(r1, r2, gap));
  c.truth = form_factor(elements_of(below, 0, 1)[0], elements_of(above, 0, 0), 64);  // all sectors are alike
  return c;
}

ClosedForm furnace(Furnace shape, float reflectance) {
  SceneMaker maker;
  const std::uint32_t m = maker.material(Spectrum(reflectance), Spectrum(exitance_of(1)));
  const auto add = [&](const Shape& s) { maker.mesh(m, s.positions, s.triangles); };
  add(shape == Furnace::kSphere ? sphere(1, 2).reversed() : box(Vec3(0.0F), Vec3(1.0F)).reversed());
  if (shape == Furnace::kCluttered) {
    add(box({0.1F, 0.0625F, 0.1F}, {0.4F, 0.6F, 0.35F}));
    add(box({0.55F, 0.125F, 0.3F}, {0.9F, 0.25F, 0.8F}));
    add(box({0.6F, 0.26F, 0.4F}, {0.7F, 0.9F, 0.5F}));  // just off the one before
  }
  ClosedForm c;
  c.form = "O9";
  c.name = text((std::string(kFurnaceNames[static_cast<int>(shape)]) + ", rho %g").c_str(), static_cast<double>(reflectance), 0, 0);
  c.scene = maker.take();
  c.closed_form = c.truth = 1 / (1 - static_cast<double>(reflectance));
  c.answer = [m](const World& world, const RadiositySolution& s) { return 1 + reflected_exitance(world, s, m); };
  c.unevenness = unevenness_about(static_cast<double>(reflectance) * c.truth);
  return c;
}

ClosedForm integrating_sphere(float reflectance) {
  const Shape all = sphere(1, 2).reversed();
  Shape lit = all, dark = all;
  lit.triangles.clear(), dark.triangles.clear();
  for (const auto& t : all.triangles) {
    const float height = all.positions[t[0]].y + all.positions[t[1]].y + all.positions[t[2]].y;
    (height > 2.1F ? lit : dark).triangles.push_back(t);
  }
  SceneMaker maker;
  maker.material(Spectrum(reflectance), Spectrum(exitance_of(1)));
  maker.material(Spectrum(reflectance));
  maker.mesh(0, lit.positions, lit.triangles).mesh(1, dark.positions, dark.triangles);
  const auto rho = static_cast<double>(reflectance);
  ClosedForm c{"O10", text("rho %g, lit on %.0f %% of the wall", rho, 100 * lit.area() / all.area(), 0), maker.take()};
  c.closed_form = rho * lit.area() / all.area() / (1 - rho);
  std::vector<DenseElement> elements = elements_of(dark, rho, 0);
  append(elements, elements_of(lit, rho, 1));
  const auto dark_mean = [&](int cells) { return mean(elements, dense_radiosity(elements, cells), 0, dark.triangles.size()); };
  set_truth(c, dark_mean(2), dark_mean(1));
  c.answer = exitance_answer(1);
  c.unevenness = unevenness_about(c.closed_form);
  return c;
}

ClosedForm dome_over_disc(float reflectance) {
  const Shape up = dome(1, 24, 6), floor = disc(1, 0, 24);
  SceneMaker maker;
  maker.material(Spectrum(reflectance), Spectrum(exitance_of(1)));
  maker.material(Spectrum(reflectance));
  maker.mesh(0, floor.positions, floor.triangles).mesh(1, up.positions, up.triangles);
  const auto rho = static_cast<double>(reflectance);
  ClosedForm c{"O11", text("rho %g", rho, 0, 0), maker.take()};
  c.closed_form = surrounded(1, 0, rho, rho, 1, 2).b2;
  std::vector<DenseElement> elements = elements_of(up, rho, 0);
  append(elements, elements_of(floor, rho, 1));
  const auto dome_mean = [&](int cells) { return mean(elements, dense_radiosity(elements, cells), 0, up.triangles.size()); };
  set_truth(c, dome_mean(3), dome_mean(1));
  c.answer = exitance_answer(1);
  return c;
}

ClosedForm concentric_spheres(float reflectance) {
  const Shape inner = sphere(0.5, 2), outer = sphere(1, 2).reversed();
  SceneMaker maker;
  maker.material(Spectrum(reflectance), Spectrum(exitance_of(1)));
  maker.material(Spectrum(reflectance));
  maker.mesh(0, inner.positions, inner.triangles).mesh(1, outer.positions, outer.triangles);
  const auto rho = static_cast<double>(reflectance);
  ClosedForm c{"O12", text("radii .5 and 1, rho %g", rho, 0, 0), maker.take()};
  c.closed_form = surrounded(1, 0, rho, rho, 1, 4).b2;
  c.truth = surrounded(1, 0, rho, rho, inner.area(), outer.area()).b2;
  c.truth_error = std::fabs(c.closed_form / c.truth - 1) + 1e-3;  // the spheres are not quite even: tessellation squared
  c.answer = exitance_answer(1);
  return c;
}

ClosedForm wide_plates(float reflectance) {
  constexpr float kSide = 20;
  SceneMaker maker;
  maker.material(Spectrum(reflectance), Spectrum(exitance_of(1)));
  maker.material(Spectrum(reflectance));
  maker.polygon(0, {{0, 0, 0}, {0, 0, kSide}, {kSide, 0, kSide}, {kSide, 0, 0}});
  maker.polygon(1, {{0, 1, 0}, {kSide, 1, 0}, {kSide, 1, kSide}, {0, 1, kSide}});
  const auto rho = static_cast<double>(reflectance);
  ClosedForm c{"O13", text("20 x 20, gap 1, rho %g", rho, 0, 0), maker.take()};
  c.closed_form = two_surfaces(1, 0, rho, rho, {{0, 1}, {1, 0}}).b2;
  const auto upper_mean = [&](int cells) {
    std::vector<DenseElement> elements = cells_of({{0, 1, 0}, {20, 1, 0}, {20, 1, 20}, {0, 1, 20}}, cells, rho, 0);
    append(elements, cells_of({{0, 0, 0}, {0, 0, 20}, {20, 0, 20}, {20, 0, 0}}, cells, rho, 1));
    return mean(elements, dense_radiosity(elements, 4), 0, static_cast<std::size_t>(cells * cells));
  };
  set_truth(c, upper_mean(16), upper_mean(8));
  c.answer = exitance_answer(1);
  return c;
}

ClosedForm coloured_box() {
  const double rho[6] = {0.5, 0.8, 0.3, 0.7, 0.6, 0.2};
  SceneMaker maker;
  for (int i = 0; i < 6; ++i) {
    maker.material(Spectrum(static_cast<float>(rho[i])), Spectrum(i == 0 ? exitance_of(1) : 0.0F));
  }
  maker.room({0, 1, 2, 3, 4, 5}, Vec3(0.0F), Vec3(1.0F));
  ClosedForm c{"O19", "box, six reflectances, floor lit", maker.take()};
  const auto ceiling_mean = [&](int cells) {
    std::vector<DenseElement> elements;
    for (std::size_t i = 0; i < 6; ++i) {
      std::vector<Vec3d> corners;
      for (const Vec3& p : c.scene.meshes[i].positions) corners.push_back(to_double(p));
      append(elements, cells_of(corners, cells, rho[i], i == 0 ? 1 : 0));
    }
    const auto a_wall = static_cast<std::size_t>(cells * cells);
    return mean(elements, dense_radiosity(elements, 2), a_wall, a_wall);
  };
  set_truth(c, ceiling_mean(10), ceiling_mean(5));
  c.closed_form = c.truth;
  c.answer = exitance_answer(1);
  return c;
}

}  // namespace radfarm::test
