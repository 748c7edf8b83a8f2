#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "estimate/audit_pixels.h"
#include "estimate/render_tile.h"
#include "estimate/settings.h"
#include "frame/round.h"
#include "frame/task.h"

namespace radfarm {

/// The tasks of a round: tiles row by row, of one image after the other, then photon batches in the same order, then audit tasks.
/// All rounds have the same tiles and batches. Requires: settings as decode_views() checks them.
std::vector<Task> cut_tasks(const Settings& settings, const Round& round, std::size_t images = 1);

/// Of one image.
std::size_t tile_count(const Settings& settings);

/// Light paths of photon task `batch` of an image, in one pass. Requires: there are batches.
std::uint64_t paths_of_batch(const Settings& settings, std::uint32_t batch);

/// The pixels of tile `index` of an image, cut off at its edge.
PixelRect tile_rect(const Settings& settings, std::uint32_t index);

/// The audited pixels of audit task `index`.
std::vector<AuditPixel> audit_task_pixels(const Settings& settings, const Round& round, std::uint32_t index);

/// All of them.
std::vector<AuditPixel> audited_pixels(const Settings& settings, const Round& round);

}  // namespace radfarm
