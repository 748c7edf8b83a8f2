#include "pipeline/solve_light.h"

#include "base/digest.h"
#include "pipeline/resolve.h"
#include "pipeline/solution_key.h"
#include "radiosity/element_mesh_file.h"
#include "radiosity/irradiance.h"
#include "senders/sender_tree.h"

namespace radfarm {
namespace {

/// What sends light when none is reflected: the emitters.
RadiositySolution emitters_alone(const World& world, std::uint64_t seed, const Progress& progress) {
  RadiositySolution solution;
  const SideNumbers sides(world.scene);
  solution.hierarchy = build_hierarchy(world, sides, reachable_sides(world, sides, seed, progress), progress);
  solution.reflected_power.resize(solution.hierarchy.nodes.size());
  return solution;
}

std::vector<std::byte> make_file(const World& world, const RadiositySolution& solution, const WantedLight& wanted,
                                 const Progress& progress) {
  if (wanted.form != LightForm::kElements) {
    return encode(make_sender_tree(solution, wanted.form == LightForm::kSenders ? SenderChoice::kBright : SenderChoice::kAll));
  }
  const std::vector<Irradiance> irradiance = gather_irradiance(world, solution, kGatherRays, wanted.seed, progress);
  progress.report("radiosity: element mesh");
  return encode(make_element_mesh(world, solution.hierarchy, irradiance));
}

}  // namespace

Result<ObtainedLight> obtain_light(const World& world, const WantedLight& wanted, const SolutionStore& store,
                                   const Progress& progress) {
  progress.report("radiosity");
  const std::string key = store.keeps() ? solution_key(world.scene, wanted.settings, wanted.seed, wanted.is_reflecting,
                                                       wanted.form, world.shining)
                                        : "";
  if (std::optional<SolvedLight> known = store.find(key)) return ObtainedLight{std::move(*known), true};
  const RadiositySolution solution = wanted.is_reflecting ? solve_radiosity(world, wanted.settings, wanted.seed, progress)
                                                          : emitters_alone(world, wanted.seed, progress);
  RADFARM_TRY_STATUS(progress.check());
  ObtainedLight obtained;
  obtained.light.facts = {solution.energy,     solution.links, solution.hierarchy.patches.size(),
                          solution.iterations, static_cast<double>(mean_radiance(solution)), wanted.form};
  obtained.light.file = make_file(world, solution, wanted, progress);
  RADFARM_TRY_STATUS(progress.check());
  obtained.light.digest = sha256_hex(obtained.light.file);
  store.keep(key, obtained.light);
  return obtained;
}

}  // namespace radfarm
