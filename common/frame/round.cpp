#include "frame/round.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kRoundKey = 0x726f756e64;  // "round"
constexpr double kMostScale = 1e6;
constexpr std::uint32_t kMostAuditPixels = 1U << 20U;
constexpr std::uint32_t kMostAuditSamples = 1U << 24U;

}  // namespace

Status check(const Round& round) {
  const bool is_sane = round.scale >= 1 && round.scale <= kMostScale && round.audit_pixels <= kMostAuditPixels &&
                       round.audit_samples <= kMostAuditSamples && (round.audit_pixels == 0) == (round.audit_samples == 0);
  if (is_sane) return {};
  return fail(Code::kInvalidArgument, "round " + std::to_string(round.number) + ": its numbers are out of range");
}

SampleBudget budget_of(const Settings& settings, const Round& round) {
  return {settings.camera_samples, settings.max_camera_samples, settings.noise, round.scale};
}

std::uint32_t photon_passes(const Round& round) { return static_cast<std::uint32_t>(std::max(1L, std::lround(round.scale))); }

std::uint64_t audit_seed(const Settings& settings, const Round& round) {
  return round.number == 0 ? settings.seed : combine(settings.seed, kRoundKey, round.number);
}

}  // namespace radfarm
