#pragma once

#include <cstdint>
#include <vector>

#include "estimate/audit_pixels.h"
#include "estimate/render_tile.h"
#include "estimate/settings.h"
#include "frame/task.h"

namespace radfarm {

/// Tiles row by row, then audit tasks. Requires: settings as decode_view() checks them.
std::vector<Task> cut_tasks(const Settings& settings);

/// The pixels of tile `index`, cut off at the image's edge.
PixelRect tile_rect(const Settings& settings, std::uint32_t index);

/// The audited pixels of audit task `index`.
std::vector<AuditPixel> audit_task_pixels(const Settings& settings, std::uint32_t index);

}  // namespace radfarm
