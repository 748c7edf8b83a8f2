#pragma once

#include <span>
#include <vector>

#include "paths/density.h"

namespace radfarm {

/// How wide discs are to be.
struct RadiusRule {
  double crossings = 400;  // that a disc is to count: noise of about 1 / sqrt(crossings)
  float least = 0;         // m
  float most = 0;          // m, > 0
};

/// The radius, m, at which a disc would count as many of `paths` paths as the rule says, by what it counted of
/// `pilot_paths`; `most` where it counted none. docs/pipeline.md (paths.6)
float choose_radius(const Disc& disc, const DiscSums& pilot, double pilot_paths, double paths, const RadiusRule& rule);

/// How much narrower discs are in batch `batch` than in batch 0: (batch + 1)^(-1/6), so that the error of the mean of
/// all batches falls as their number to -1/3, bias and noise alike. (paths.6)
double shrinking(std::uint64_t batch);

}  // namespace radfarm
