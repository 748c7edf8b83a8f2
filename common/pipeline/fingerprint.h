#pragma once

#include <string>
#include <vector>

#include "scene/surface.h"

namespace radfarm {

/// Names this build: version, compiler, instruction set, checks. Equal builds may share a job.
std::string build_id();

/// SHA-256 of the running program's file. Builds that are called the same differ in it while the code is worked on.
std::string program_digest();

/// What this machine's ray caster answers to fixed rays against a fixed scene; Hit() where a ray meets nothing.
struct RaySelfTest {
  std::string caster;  // ray_caster_name()
  std::vector<Hit> hits;
};
RaySelfTest ray_self_test();

/// SHA-256 over a fixed self-test of this machine's arithmetic: libm results over a fixed table, and the ray caster's
/// name and hits. Machines that differ here would render other bits, so a job's tasks go only to workers of one
/// fingerprint. Cost: some milliseconds.
std::string numeric_fingerprint(const RaySelfTest& rays = ray_self_test());

}  // namespace radfarm
