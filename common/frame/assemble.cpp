#include "frame/assemble.h"

#include <algorithm>
#include <array>
#include <string>

#include "frame/aov_layers.h"
#include "frame/tasks.h"
#include "math/statistics.h"

namespace radfarm {
namespace {

struct Layer {
  const char* prefix;
  SpectrumD (*value)(const PixelSums&);
};

constexpr Layer kLayers[] = {
    {"", [](const PixelSums& p) { return p.emission + p.reflected(); }},
    {"emission.", [](const PixelSums& p) { return p.emission; }},
    {"direct.", [](const PixelSums& p) { return p.direct; }},
    {"indirect.", [](const PixelSums& p) { return p.indirect; }},
    {"specular.", [](const PixelSums& p) { return p.specular; }},
};

}  // namespace

namespace {

/// Turns the mean that photon paths brought a pixel into sums over its samples, as if each had brought it.
void add_to(PixelSums& pixel, const std::array<SpectrumD, 3>& brought, double variance) {
  const double n = pixel.samples;
  pixel.direct += brought[0] * n;
  pixel.indirect += brought[1] * n;
  pixel.specular += brought[2] * n;
  const double mean = n > 0 ? luminance(pixel.reflected()) / n : 0;
  // Of n samples whose mean has this variance, if there is more than one.
  pixel.squared_luminance = n * (mean * mean + std::max(0.0, n - 1) * variance);
}

}  // namespace

Status add_photons(std::span<const PhotonResult> results, Raster& raster) {
  if (results.empty()) return {};
  double paths = 0;
  for (const PhotonResult& result : results) {
    if (result.pixels.size() != raster.pixels.size() || result.paths == 0) {
      return fail(Code::kDataLoss, "photon result: is not of the image");
    }
    paths += static_cast<double>(result.paths);
    raster.counters.photon_paths += result.paths;
  }
  for (std::size_t i = 0; i < raster.pixels.size(); ++i) {
    std::array<SpectrumD, 3> brought{};
    RunningStatistics batches;
    for (const PhotonResult& result : results) {
      const PhotonPixel& p = result.pixels[i];
      brought[0] += SpectrumD(p.direct) / paths;
      brought[1] += SpectrumD(p.indirect) / paths;
      brought[2] += SpectrumD(p.specular) / paths;
      batches.add(luminance(SpectrumD(p.direct) + SpectrumD(p.indirect) + SpectrumD(p.specular)) / static_cast<double>(result.paths));
    }
    const double error = batches.standard_error();
    add_to(raster.pixels[i], brought, error * error);
  }
  return {};
}

Result<Raster> assemble(const Settings& settings, std::span<const TileResult> tiles) {
  Raster raster;
  const auto width = static_cast<std::size_t>(settings.width);
  raster.pixels.resize(width * static_cast<std::size_t>(settings.height));
  const bool has_aovs = settings.aovs != 0, shares = settings.shares_light != 0;
  const bool has_needs = !tiles.empty() && !tiles[0].needs.empty();
  if (has_aovs) raster.aovs.resize(raster.pixels.size());
  if (shares) raster.sharing.resize(raster.pixels.size());
  if (has_needs) raster.needs.resize(raster.pixels.size());
  std::vector<bool> filled(raster.pixels.size());
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < tiles.size(); ++i) {
    const TileResult& tile = tiles[i];
    if (tile.rect != tile_rect(settings, i)) return fail(Code::kDataLoss, "tile " + std::to_string(i) + " is misplaced");
    if (has_aovs && tile.aovs.size() != tile.pixels.size()) {
      return fail(Code::kDataLoss, "tile " + std::to_string(i) + " has no AOVs");
    }
    if (shares && tile.sharing.size() != tile.pixels.size()) {
      return fail(Code::kDataLoss, "tile " + std::to_string(i) + " has nothing to share");
    }
    if (has_needs != !tile.needs.empty()) {
      return fail(Code::kDataLoss, "tile " + std::to_string(i) + " does not say what its pixels need");
    }
    raster.counters += tile.counters;
    std::size_t next = 0;
    for (int y = tile.rect.y0; y < tile.rect.y1; ++y) {
      for (int x = tile.rect.x0; x < tile.rect.x1; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        if (filled[pixel]) return fail(Code::kDataLoss, "tile " + std::to_string(i) + " covers another");
        filled[pixel] = true;
        if (has_aovs) raster.aovs[pixel] = tile.aovs[next];
        if (shares) raster.sharing[pixel] = tile.sharing[next];
        raster.pixels[pixel] = tile.pixels[next];
        if (has_needs) {
          raster.needs[pixel] = tile.needs[next];
          complete_emission(tile.needs[next], raster.pixels[pixel]);
        }
        ++next;
        ++count;
      }
    }
  }
  if (count != raster.pixels.size()) return fail(Code::kDataLoss, "the tiles leave pixels uncovered");
  return raster;
}

Image to_image(const Settings& settings, const Raster& raster) {
  Image image;
  image.width = settings.width;
  image.height = settings.height;
  for (const Layer& layer : kLayers) {
    const std::string prefix = layer.prefix;
    std::vector<float> r, g, b;
    for (const PixelSums& pixel : raster.pixels) {
      const SpectrumD mean = layer.value(pixel) / static_cast<double>(pixel.samples);
      r.push_back(static_cast<float>(mean.r));
      g.push_back(static_cast<float>(mean.g));
      b.push_back(static_cast<float>(mean.b));
    }
    image.channels[prefix + "R"] = std::move(r);
    image.channels[prefix + "G"] = std::move(g);
    image.channels[prefix + "B"] = std::move(b);
  }
  if (settings.aovs != 0) add_aov_layers(settings.aovs, raster, image);
  return image;
}

double dropped_share(const Raster& raster) {
  double dropped = 0, all = 0;
  for (const PixelSums& pixel : raster.pixels) {
    dropped += pixel.dropped;
    all += static_cast<double>(pixel.dropped) + pixel.samples;
  }
  return all > 0 ? dropped / all : 0;
}

}  // namespace radfarm
