#include "sharing/local_fit.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

struct Neighbour {
  std::array<float, 4> features;
  float weight;
};

std::vector<Neighbour> random_neighbours(std::size_t count) {
  RandomSequence random(7);
  std::vector<Neighbour> all(count);
  for (Neighbour& one : all) {
    for (float& f : one.features) f = 2 * random.uniform() - 1;
    one.weight = random.uniform();
  }
  return all;
}

void add(const Neighbour& one, std::size_t lane, const std::array<float, 3>& values, LocalFits& fits) {
  fits.add(lane, 1, &one.weight, {&one.features[0], &one.features[1], &one.features[2], &one.features[3]},
           {&values[0], &values[1], &values[2]});
}

TEST(LocalFits, FindWhatIsLinearAtZero) {
  LocalFits fits(3);
  for (const Neighbour& n : random_neighbours(200)) {
    const auto& f = n.features;
    add(n, 1, {5.0F, 5 + 2 * f[0] - f[3], 1 + 3 * f[1] + f[2]}, fits);
  }
  const auto at = fits.at_zero(1);
  // The ridge holds slopes back by about 3 parts in 1000 of slopes of order 1, and their means are not quite zero.
  EXPECT_NEAR(at[0], 5, 1e-4);
  EXPECT_NEAR(at[1], 5, 2e-3);
  EXPECT_NEAR(at[2], 1, 2e-3);
}

TEST(LocalFits, LanesAreApart) {
  LocalFits fits(100);
  std::vector<float> weights(100, 1.0F), zeros(100, 0.0F), values(100);
  for (std::size_t i = 0; i < 100; ++i) values[i] = static_cast<float>(i);
  fits.add(0, 100, weights.data(), {zeros.data(), zeros.data(), zeros.data(), zeros.data()},
           {values.data(), values.data(), zeros.data()});
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(fits.at_zero(i)[0], static_cast<double>(i), 1e-9);
}

TEST(LocalFits, OneNeighbourIsItself) {
  LocalFits fits(1);
  add({{0, 0, 0, 0}, 0.25F}, 0, {1, 2, 3}, fits);
  const auto at = fits.at_zero(0);
  EXPECT_NEAR(at[0], 1, 1e-6);
  EXPECT_NEAR(at[2], 3, 1e-6);
}

TEST(LocalFits, FeaturesThatDoNotVaryDoNoHarm) {
  LocalFits fits(1);
  for (Neighbour n : random_neighbours(50)) {
    n.features = {n.features[0], 0, 0, n.features[0]};  // one twice, two not at all
    add(n, 0, {4 + n.features[0], 0, 0}, fits);
  }
  EXPECT_NEAR(fits.at_zero(0)[0], 4, 2e-3);
}

}  // namespace
}  // namespace radfarm
