#pragma once

#include <string>

namespace radfarm {

/// Names this build: version, compiler, instruction set, checks. Equal builds may share a job.
std::string build_id();

/// SHA-256 over a fixed self-test of this machine's arithmetic: libm results over a fixed table. Machines that differ
/// here would render other bits, so a job's tasks go only to workers of one fingerprint. Cost: a millisecond.
std::string numeric_fingerprint();

}  // namespace radfarm
