// Nanoseconds of a Bsdf: made, evaluated and sampled at one point, as an eye path does. One thread; needs Google Benchmark.

#include <benchmark/benchmark.h>

#include "base/random.h"
#include "matter/bsdf.h"

namespace radfarm {
namespace {

Matter lambertian() { return {}; }

Matter dielectric() {
  Matter m;
  m.specular = 1;
  m.roughness = 0.4F;
  return m;
}

Matter metal() {
  Matter m = dielectric();
  m.metallic = 1;
  return m;
}

Matter coated() {
  Matter m = dielectric();
  m.clearcoat = 1;
  m.clearcoat_roughness = 0.1F;
  return m;
}

Matter glass() {
  Matter m = dielectric();
  m.transmission = 1;
  m.has_volume = true;
  return m;
}

Vec3 direction_of(int k) { return normalize(Vec3(0.3F, 0.1F * static_cast<float>(k % 8), 0.8F)); }

/// The tables are made before the clock runs.
void make(benchmark::State& state, Matter (*matter_of)()) {
  const Matter matter = matter_of();
  const Frame frame(Vec3(0, 0, 1));
  benchmark::DoNotOptimize(Bsdf(matter, frame, direction_of(0), true));
  int k = 0;
  for (auto _ : state) {
    const Bsdf bsdf(matter, frame, direction_of(++k), true);
    benchmark::DoNotOptimize(bsdf);
  }
}

void eval(benchmark::State& state, Matter (*matter_of)()) {
  const Bsdf bsdf(matter_of(), Frame(Vec3(0, 0, 1)), direction_of(1), true);
  int k = 0;
  for (auto _ : state) {
    const Vec3 i = direction_of(++k);
    benchmark::DoNotOptimize(bsdf.eval_diffuse(i) + bsdf.eval_specular(i));
    benchmark::DoNotOptimize(bsdf.pdf_specular(i));
  }
}

void sample(benchmark::State& state, Matter (*matter_of)()) {
  const Bsdf bsdf(matter_of(), Frame(Vec3(0, 0, 1)), direction_of(1), true);
  RandomSequence random(1);
  for (auto _ : state) {
    const float choice = random.uniform(), u = random.uniform();
    benchmark::DoNotOptimize(bsdf.sample_specular(choice, {u, random.uniform()}));
  }
}

#define RADFARM_BENCH(MATTER)            \
  BENCHMARK_CAPTURE(make, MATTER, MATTER); \
  BENCHMARK_CAPTURE(eval, MATTER, MATTER); \
  BENCHMARK_CAPTURE(sample, MATTER, MATTER)
RADFARM_BENCH(lambertian);
RADFARM_BENCH(dielectric);
RADFARM_BENCH(metal);
RADFARM_BENCH(coated);
RADFARM_BENCH(glass);

}  // namespace
}  // namespace radfarm

BENCHMARK_MAIN();
