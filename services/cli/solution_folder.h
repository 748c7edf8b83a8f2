#pragma once

#include <cstdint>
#include <filesystem>

namespace radfarm::cli {

/// What is kept there at most; used longest ago goes first.
inline constexpr std::uint64_t kSolutionBytes = std::uint64_t{2} << 30U;

/// Where `radfarm render` and `bake` keep solved light from one run to the next: radfarm/solutions in $XDG_CACHE_HOME, else in ~/.cache.
/// Made when needed, for this user alone. Empty where there is no such place or nothing can be written: then nothing is kept.
std::filesystem::path solution_folder();

}  // namespace radfarm::cli
