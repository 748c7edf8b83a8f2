// `radfarm compare`: how far one image is from another.
#include "image/compare.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/commands.h"
#include "cli/deliver.h"
#include "image/color_map.h"
#include "image/digest.h"
#include "image/exr.h"
#include "image/flip.h"
#include "image/png.h"
#include "image/tone_map.h"
#include "rpc/limits.h"

namespace radfarm::cli {
namespace {

struct CompareFlags {
  std::filesystem::path a, b;
  std::string regions;      // COLUMNSxROWS; "": none
  std::string exposure = "auto";
  std::filesystem::path flip_map;
  bool json = false;
};

Result<Image> read_image(const std::filesystem::path& path) {
  RADFARM_TRY(const std::string bytes, read_file(path, limits::kBlobBytes));
  Result<Image> image = decode_exr(std::as_bytes(std::span(bytes)));
  if (!image) return annotate(image.error(), path.string());
  return image;
}

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json("infinite");
}

nlohmann::ordered_json summary_of(const Image& a, const Image& b, const Comparison& c, const FlipMap& seen) {
  return {{"identical", image_digest(a) == image_digest(b)},
          {"rmse", number(c.rmse)},
          {"relative_rmse", number(c.relative_rmse)},
          {"relmse", number(c.relmse)},
          {"ratio_of_means", number(c.ratio_of_means)},
          {"max_difference", number(c.max_difference)},
          {"flip", seen.mean},
          {"mean_a", number(c.mean_a)},
          {"mean_b", number(c.mean_b)},
          {"pixels", c.pixels},
          {"not_finite", c.not_finite}};
}

/// "4x3".
Result<std::array<int, 2>> parse_grid(const std::string& text) {
  std::array<int, 2> grid{};
  char end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &grid[0], &grid[1], &end) == 2) return grid;
  return fail(Code::kInvalidArgument, "--regions: '" + text + "' is not COLUMNSxROWS, such as 4x3");
}

Result<nlohmann::ordered_json> regions_json(const Image& a, const Image& b, const std::string& text) {
  RADFARM_TRY(const auto grid, parse_grid(text));
  RADFARM_TRY(const std::vector<RegionError> regions, compare_regions(a, b, grid[0], grid[1]));
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const RegionError& r : regions) {
    rows.push_back({{"x0", r.x0}, {"y0", r.y0}, {"x1", r.x1}, {"y1", r.y1}, {"rmse", number(r.rmse)},
                    {"relative_rmse", number(r.relative_rmse)}, {"ratio_of_means", number(r.ratio_of_means)}, {"share", r.share}});
  }
  return rows;
}

void print(const nlohmann::ordered_json& json) {
  for (const auto& [name, value] : json.items()) {
    if (name != "regions") std::printf("%-16s %s\n", name.c_str(), value.dump().c_str());
  }
  if (!json.contains("regions")) return;
  std::printf("\n%-24s %12s %14s %16s %12s\n", "region", "rmse", "relative rmse", "ratio of means", "of all MSE");
  for (const auto& r : json["regions"]) {
    const std::string place = r["x0"].dump() + "," + r["y0"].dump() + " to " + r["x1"].dump() + "," + r["y1"].dump();
    std::printf("%-24s %12.4g %14s %16s %10.1f %%\n", place.c_str(), r["rmse"].is_number() ? r["rmse"].get<double>() : 0.0,
                r["relative_rmse"].dump().substr(0, 8).c_str(), r["ratio_of_means"].dump().substr(0, 8).c_str(),
                100 * r["share"].get<double>());
  }
}

Status write_flip(const FlipMap& seen, const std::filesystem::path& file) {
  std::vector<Rgba8> pixels;
  for (const float value : seen.values) pixels.push_back(viridis(value));
  RADFARM_TRY(const auto png, encode_png(static_cast<std::uint32_t>(seen.width), static_cast<std::uint32_t>(seen.height), pixels));
  return write_file_atomically(file, png);
}

Result<ExitCode> run_compare(const CompareFlags& flags) {
  const Result<std::optional<float>> exposure = parse_exposure(flags.exposure);
  if (!exposure) return usage_error(exposure.error());
  RADFARM_TRY(const Image a, read_image(flags.a));
  RADFARM_TRY(const Image b, read_image(flags.b));
  const Result<Comparison> compared = compare(a, b);
  if (!compared) return annotate(compared.error(), flags.a.string() + " and " + flags.b.string());
  RADFARM_TRY(const FlipMap seen, flip(a, b, exposure->value_or(auto_exposure(b))));
  nlohmann::ordered_json json = summary_of(a, b, *compared, seen);
  if (!flags.regions.empty()) {
    RADFARM_TRY(json["regions"], regions_json(a, b, flags.regions));
  }
  if (!flags.flip_map.empty()) RADFARM_TRY_STATUS(write_flip(seen, flags.flip_map));
  if (flags.json) {
    std::printf("%s\n", json.dump(2).c_str());
  } else {
    print(json);
  }
  return ExitCode::kDone;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("compare", "how far image A is from image B, the reference");
  const auto flags = std::make_shared<CompareFlags>();  // shared: by the parser and by the action
  verb.add_option("A", flags->a, "A.exr")->required();
  verb.add_option("B", flags->b, "B.exr, the reference")->required();
  verb.add_option("--regions", flags->regions, "COLUMNSxROWS: the error of each part as well");
  verb.add_option("--exposure", flags->exposure, "EV (stops) or auto, by B: at which FLIP looks at both");
  verb.add_option("--flip-map", flags->flip_map, "OUT.png: FLIP by pixel, from violet (0) to yellow (1)");
  verb.add_flag("--json", flags->json, "for programs");
  verb.callback([&action, flags] { action = [flags] { return run_compare(*flags); }; });
}

}  // namespace radfarm::cli
