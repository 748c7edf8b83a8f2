// `radfarm compare`: how far one image is from another.
#include "image/compare.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/commands.h"
#include "image/digest.h"
#include "image/exr.h"
#include "rpc/limits.h"

namespace radfarm::cli {
namespace {

struct CompareFlags {
  std::filesystem::path a, b;
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

Result<ExitCode> run_compare(const CompareFlags& flags) {
  RADFARM_TRY(const Image a, read_image(flags.a));
  RADFARM_TRY(const Image b, read_image(flags.b));
  const Result<Comparison> compared = compare(a, b);
  if (!compared) return annotate(compared.error(), flags.a.string() + " and " + flags.b.string());
  const bool identical = image_digest(a) == image_digest(b);
  const nlohmann::ordered_json json = {{"identical", identical},
                                       {"rmse", number(compared->rmse)},
                                       {"relative_rmse", number(compared->relative_rmse)},
                                       {"relmse", number(compared->relmse)},
                                       {"ratio_of_means", number(compared->ratio_of_means)},
                                       {"max_difference", number(compared->max_difference)},
                                       {"mean_a", number(compared->mean_a)},
                                       {"mean_b", number(compared->mean_b)},
                                       {"pixels", compared->pixels},
                                       {"not_finite", compared->not_finite}};
  if (flags.json) {
    std::printf("%s\n", json.dump(2).c_str());
    return ExitCode::kDone;
  }
  for (const auto& [name, value] : json.items()) std::printf("%-16s %s\n", name.c_str(), value.dump().c_str());
  return ExitCode::kDone;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("compare", "how far image A is from image B, the reference");
  const auto flags = std::make_shared<CompareFlags>();  // shared: by the parser and by the action
  verb.add_option("A", flags->a, "A.exr")->required();
  verb.add_option("B", flags->b, "B.exr, the reference")->required();
  verb.add_flag("--json", flags->json, "for programs");
  verb.callback([&action, flags] { action = [flags] { return run_compare(*flags); }; });
}

}  // namespace radfarm::cli
