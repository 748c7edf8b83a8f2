#include "frame/tasks.h"

#include <algorithm>

namespace radfarm {
namespace {

constexpr std::size_t kAuditPixelsPerTask = 32;

int tiles_across(int pixels, int tile) { return (pixels + tile - 1) / tile; }

}  // namespace

std::size_t tile_count(const Settings& settings) {
  return static_cast<std::size_t>(tiles_across(settings.width, settings.tile)) *
         static_cast<std::size_t>(tiles_across(settings.height, settings.tile));
}

std::vector<Task> cut_tasks(const Settings& settings, const Round& round, std::size_t images) {
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < images * tile_count(settings); ++i) {
    tasks.push_back({Task::Kind::kTile, static_cast<std::uint32_t>(i)});
  }
  for (std::size_t i = 0; i < images * settings.photon_batches; ++i) {
    tasks.push_back({Task::Kind::kPhotons, static_cast<std::uint32_t>(i)});
  }
  const std::size_t audited = audited_pixels(settings, round).size();
  for (std::size_t first = 0; first < audited; first += kAuditPixelsPerTask) {
    tasks.push_back({Task::Kind::kAudit, static_cast<std::uint32_t>(first / kAuditPixelsPerTask)});
  }
  return tasks;
}

std::uint64_t paths_of_batch(const Settings& settings, std::uint32_t batch) {
  const std::uint64_t each = settings.photons / settings.photon_batches, left = settings.photons % settings.photon_batches;
  return each + (batch < left ? 1 : 0);
}

PixelRect tile_rect(const Settings& settings, std::uint32_t index) {
  const int columns = tiles_across(settings.width, settings.tile);
  const int x0 = static_cast<int>(index) % columns * settings.tile;
  const int y0 = static_cast<int>(index) / columns * settings.tile;
  return {x0, y0, std::min(x0 + settings.tile, settings.width), std::min(y0 + settings.tile, settings.height)};
}

std::vector<AuditPixel> audit_task_pixels(const Settings& settings, const Round& round, std::uint32_t index) {
  const std::vector<AuditPixel> all = audited_pixels(settings, round);
  const std::size_t begin = std::min(all.size(), index * kAuditPixelsPerTask);
  const std::size_t end = std::min(all.size(), begin + kAuditPixelsPerTask);
  return {all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)};
}

std::vector<AuditPixel> audited_pixels(const Settings& settings, const Round& round) {
  return choose_audit_pixels(settings.width, settings.height, round.audit_pixels, audit_seed(settings, round));
}

}  // namespace radfarm
