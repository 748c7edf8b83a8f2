#include "image/reference_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/rgb.h"
#include "math/spectrum.h"

namespace radfarm {
namespace {

constexpr int kBlock = 16;    // pixels a side: neighbours know of each other, blocks hardly
constexpr double kZ = 1.96;   // 95 %

/// Luminance of what surfaces reflect, by pixel.
Result<std::vector<double>> reflected(const Image& image) {
  RADFARM_TRY(const RgbLayer all, rgb_layer(image));
  const Result<RgbLayer> emission = rgb_layer(image, "emission");
  std::vector<double> values;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const SpectrumD emitted = emission ? SpectrumD(emission->at(i)) : SpectrumD();
    values.push_back(luminance(SpectrumD(all.at(i)) - emitted));
  }
  return values;
}

struct Block {
  double products = 0, count = 0;
};

struct Sums {
  std::vector<Block> blocks;
  double x = 0, reference = 0, between = 0, products = 0, count = 0;
};

Sums sum_up(const std::vector<double>& x, const std::vector<double>& a, const std::vector<double>& b, int width) {
  Sums sums;
  const auto columns = static_cast<std::size_t>((width + kBlock - 1) / kBlock);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
    const std::size_t row = i / static_cast<std::size_t>(width) / kBlock, column = i % static_cast<std::size_t>(width) / kBlock;
    const std::size_t block = row * columns + column;
    if (block >= sums.blocks.size()) sums.blocks.resize(block + 1);
    const double product = (x[i] - a[i]) * (x[i] - b[i]);
    sums.blocks[block].products += product, sums.blocks[block].count += 1;
    sums.products += product, sums.count += 1;
    sums.x += x[i], sums.reference += (a[i] + b[i]) / 2, sums.between += (a[i] - b[i]) * (a[i] - b[i]) / 4;
  }
  return sums;
}

}  // namespace

Result<ReferenceError> reference_error(const Image& image, const Image& half_a, const Image& half_b) {
  for (const Image* half : {&half_a, &half_b}) {
    if (half->width != image.width || half->height != image.height) {
      return fail(Code::kInvalidArgument, "the reference differs from the image in size");
    }
  }
  RADFARM_TRY(const std::vector<double> x, reflected(image));
  RADFARM_TRY(const std::vector<double> a, reflected(half_a));
  RADFARM_TRY(const std::vector<double> b, reflected(half_b));
  const Sums sums = sum_up(x, a, b, image.width);
  if (!(sums.count > 0)) return fail(Code::kInvalidArgument, "no pixel is finite in image and reference");
  ReferenceError error;
  error.mse = sums.products / sums.count;
  error.mean = sums.reference / sums.count;
  double scatter = 0;
  for (const Block& block : sums.blocks) scatter += std::pow(block.products - error.mse * block.count, 2);
  const double half = kZ * std::sqrt(scatter) / sums.count;
  const auto relative = [&](double mse) { return error.mean > 0 ? std::sqrt(std::max(0.0, mse)) / error.mean : 0; };
  error.relative = relative(error.mse);
  error.relative_low = relative(error.mse - half), error.relative_high = relative(error.mse + half);
  error.reference_relative = relative(sums.between / sums.count);
  error.ratio_of_means = sums.reference != 0 ? sums.x / sums.reference : 1;
  return error;
}

}  // namespace radfarm
