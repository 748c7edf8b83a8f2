#pragma once

#include "estimate/render_tile.h"
#include "scene/world.h"

namespace radfarm {

/// The paper's adaptive oversampling: one sample at each corner of the pixels, which up to four pixels share, and `samples`
/// more inside pixels whose corners look at different objects. The same bits however the image is tiled. docs/pipeline.md
/// (paper.7)
std::vector<PixelSums> render_paper_tile(const World& world, const Film& film, const PixelRect& rect, std::uint32_t samples,
                                         const SampleRadiance& radiance, Counters& counters);

}  // namespace radfarm
