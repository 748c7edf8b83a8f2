#include "estimate/radiance_parts.h"

#include <array>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

using enum PathStage;

enum class Part { kEmission, kDirect, kIndirect, kSpecular };

Part name_of(RadianceParts& parts, const Spectrum& part) {
  if (&part == &parts.emission) return Part::kEmission;
  if (&part == &parts.direct) return Part::kDirect;
  return &part == &parts.indirect ? Part::kIndirect : Part::kSpecular;
}

/// What becomes of light and of the path at one stage.
struct Row {
  PathStage stage;
  Part emitted;                  // what the path meets emits
  Part by_diffuse, by_specular;  // light of emitters, scattered by a lobe
  PathStage after_diffuse, after_specular;
};

constexpr std::array kTable = {
    // camera ... meets something: what emits is seen; the first diffuse lobe makes the receiver
    Row{kSeen, Part::kEmission, Part::kDirect, Part::kSpecular, kReceiver, kEyeChain},
    // camera, specular+ ...: emitters seen by mirrors are no `emission`, but the receiver may still come
    Row{kEyeChain, Part::kSpecular, Part::kDirect, Part::kSpecular, kReceiver, kEyeChain},
    // receiver ... meets an emitter: direct; else light comes from a diffuse or from a specular surface
    Row{kReceiver, Part::kDirect, Part::kIndirect, Part::kSpecular, kIndirect, kSpecular},
    // receiver, diffuse ...: the class is settled by the last vertex before the receiver
    Row{kIndirect, Part::kIndirect, Part::kIndirect, Part::kIndirect, kIndirect, kIndirect},
    // receiver, specular ...
    Row{kSpecular, Part::kSpecular, Part::kSpecular, Part::kSpecular, kSpecular, kSpecular},
};

TEST(PathStage, SaysWhichPartLightBelongsToAndWhereThePathIsNext) {
  for (const Row& row : kTable) {
    RadianceParts parts;
    const auto stage = static_cast<int>(row.stage);
    EXPECT_EQ(name_of(parts, part_of_emission(parts, row.stage)), row.emitted) << stage;
    EXPECT_EQ(name_of(parts, part_of_scattering(parts, row.stage, false)), row.by_diffuse) << stage;
    EXPECT_EQ(name_of(parts, part_of_scattering(parts, row.stage, true)), row.by_specular) << stage;
    EXPECT_EQ(stage_after(row.stage, false), row.after_diffuse) << stage;
    EXPECT_EQ(stage_after(row.stage, true), row.after_specular) << stage;
  }
}

TEST(PathStage, NextEventsAndHitsOfAnEmitterAgree) {
  // Both are weighed against each other: in two classes, neither would be whole.
  for (const Row& row : kTable) {
    for (const bool is_specular : {false, true}) {
      RadianceParts parts;
      const Spectrum& by_event = part_of_scattering(parts, row.stage, is_specular);
      const Spectrum& by_hit = part_of_emission(parts, stage_after(row.stage, is_specular));
      EXPECT_EQ(&by_event, &by_hit) << static_cast<int>(row.stage) << is_specular;
    }
  }
}

TEST(RadianceParts, ReflectedIsAllThatIsNotEmission) {
  const RadianceParts parts{Spectrum(1.0F), Spectrum(2.0F), Spectrum(4.0F), Spectrum(8.0F)};
  EXPECT_EQ(parts.reflected(), Spectrum(14.0F));
}

}  // namespace
}  // namespace radfarm
