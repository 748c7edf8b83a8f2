#pragma once

#include <vector>

#include "base/progress.h"
#include "radiosity/links.h"
#include "radiosity/settings.h"

namespace radfarm {

/// Powers that the nodes send now, lm, one a node: emitted lives in the nodes, reflected here.
using NodePower = std::vector<Spectrum>;

/// The first link of all: the root to itself, and every punctual light to the root. Not evaluated.
std::vector<Link> initial_links(const World& world, const Hierarchy& hierarchy);

/// Refines links until each one's oracle error, the reflected power it may misplace, is below max_link_error x
/// `emitted_flux`, or its elements cannot be cut further. With no room for all below max_links, the links that may misplace
/// most are cut.      docs/pipeline.md (radiosity.4)
///
/// Level by level: all candidates of a level are evaluated in parallel, then accepted or split in order, so that the result
/// does not depend on the number of threads.
/// Returns the number of links split.
std::size_t refine(const World& world, Hierarchy& hierarchy, NodePower& reflected, std::vector<Link>& links,
                   const RadiositySettings& settings, double emitted_flux, std::uint64_t seed,
                   const Progress& progress = {});

/// Evaluates the reflected part of every link with fresh random lines, and drops links that carry none. Links were accepted
/// because their samples varied little, so those samples are biased: a link whose lines happened to miss was kept, one whose
/// lines hit was cut. Factors measured after the decision are unbiased.
void measure_again(const World& world, Hierarchy& hierarchy, const NodePower& reflected, std::vector<Link>& links,
                   const RadiositySettings& settings, std::uint64_t seed, const Progress& progress = {});

}  // namespace radfarm
