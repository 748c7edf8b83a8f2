#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/solve.h"

namespace radfarm {

/// What a solution is made into: what a gather samples, or what is looked at.
enum class LightForm : std::uint64_t { kSenders, kAllSenders, kElements };

/// What a radiosity solve leaves: all that the stages after it and the report need, independent of any camera.
struct SolvedLight {
  struct Facts {
    EnergyLedger energy;
    std::uint64_t links = 0;
    std::uint64_t elements = 0;
    std::uint64_t iterations = 0;
    double mean_radiance = 0;  // cd/m^2, that thresholds are shares of; a float's value
    LightForm form = LightForm::kSenders;
  };
  Facts facts;
  std::vector<std::byte> file;  // a flat file: SenderTree of kind "solution", or ElementMesh of kind "elements"
  std::string digest;           // SHA-256 of `file`
};

/// Solved light in a folder, one file a key (docs/formats.md, kind "solved"). Any number of processes may use one folder. An entry
/// appears whole or not at all; one that is damaged, of another version or under a wrong name is not there. Nothing here ever
/// fails a render: a folder that cannot be used keeps nothing, and the log says so.
class SolutionStore {
 public:
  SolutionStore() = default;  // keeps nothing
  /// The folder is made when something is kept. Entries used longest ago go when all together exceed `max_bytes`.
  SolutionStore(std::filesystem::path folder, std::uint64_t max_bytes)
      : folder_(std::move(folder)), max_bytes_(max_bytes) {}

  bool keeps() const { return !folder_.empty() && max_bytes_ > 0; }
  /// Cost: reads and hashes the entry.
  std::optional<SolvedLight> find(const std::string& key) const;
  void keep(const std::string& key, const SolvedLight& light) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t max_bytes_ = 0;
};

}  // namespace radfarm
