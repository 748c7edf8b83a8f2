#pragma once

#include <string>
#include <vector>

#include "frame/assemble.h"
#include "image/image.h"

namespace radfarm {

/// Adds the layer light.NAME: direct, indirect and specular light of one light group. A pixel without any kept sample is NaN.
void add_light_layer(const std::string& group, const Raster& raster, Image& image);

/// Adds a light group's image to that of other groups: the means of both add up, samples and what was counted, too, and the
/// variances of the means, as their random numbers are independent (frame/view.h). Light and accepted thresholds of AOVs add up;
/// what does not depend on light, and the grid's classes and numbers, stay those of the first group. Where one of both kept no
/// sample, the sum has none. Requires: rasters of one size with the same AOVs. What pixels share stays behind: it has done its
/// work.
void add_light_group(const Raster& group, Raster& sum);

/// The groups that an image has layers light.NAME of, by name.
std::vector<std::string> light_groups_of(const Image& image);

/// One of these layers at the root of an image. Requires: light_groups_of(image) has it.
Image light_layer(const Image& image, const std::string& group);

}  // namespace radfarm
