#pragma once

#include <vector>

namespace radfarm {

/// Luminance over width x height pixels, cd/m^2 where nothing else is said, row 0 at the top.
struct LuminanceImage {
  int width = 0;
  int height = 0;
  std::vector<float> values;
};

/// The luminance, cd/m^2, at which a display shows an image's white: what is 1 after exposure.
inline constexpr double kDisplayWhite = 100;

/// What the display shows of an image after so many stops of exposure: white at most.
LuminanceImage displayed(const LuminanceImage& image, float exposure_ev);

/// Smallest difference of luminance, cd/m^2, that an eye adapted to `luminance` (cd/m^2) sees: Ward Larson's fit of
/// Ferwerda's rods and cones, its joins closed so that it never falls. Below 1e-5 cd/m^2 it is that of 1e-5. docs/pipeline.md
/// (masking.1)
double visible_difference(double luminance);

/// Sensitivity to contrast, 1 / least visible contrast, of a grating of so many cycles per degree, clamped to [0.1, 60], on a
/// field of so many cd/m^2 [Barten 1989]. (masking.2)
double contrast_sensitivity(double cycles_per_degree, double luminance);

/// How many times larger a threshold is on a pattern whose contrast is so many times its own threshold [Daly 1993].   (masking.3)
double masking_by(double normalised_contrast);

/// What an image as it is displayed hides.
struct Visibility {
  LuminanceImage adaptation;  // cd/m^2, to which the eye is adapted: the mean over about a degree
  LuminanceImage elevation;   // by which detail raises the threshold there, >= 1
};

/// Masking by the contrasts of a Gaussian pyramid's octaves, as Yee's perceptual metric has it, but for shading coarser than
/// a cycle a degree. `shown` in cd/m^2 on the display; values that are not finite or negative count as 0. (masking.4)
/// O(pixels), about 1 us each, on all threads. Requires: max_elevation >= 1, pixels_per_degree > 0.
Visibility judge_visibility(const LuminanceImage& shown, double pixels_per_degree, float max_elevation);

/// Mean over the image; 0 of none.
double mean_of(const LuminanceImage& image);

}  // namespace radfarm
