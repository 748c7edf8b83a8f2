#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/disc_caster.h"

namespace radfarm::bench {

/// The piece of a ray that carries light.
struct Piece {
  Ray ray;  // unit direction
  float begin = 0;
  float end = 0;  // may be infinite
};

/// Whether the piece crosses the disc from its front. In double.
bool crosses(const Piece& piece, const OrientedDisc& disc);

/// How the paper's rays are put in order.
struct RayGridSettings {
  int rings = 32;    // of patches of directions, from pole to pole: some 4 / pi rings^2 patches
  int columns = 32;  // cells a side of each patch's grid
};

/// The paper's ray discretisation [3, 3.4 and 3.5], to compare with: rays are kept, in patches of directions, each with
/// a grid on a plane across its mean direction; a disc is projected along that direction, its shadow widened by the
/// patch's angle, and rays in the cells below it go through the Pluecker test with a triangle around the disc, then the
/// exact one.
class RayGrid {
 public:
  /// 60 bytes a ray, 4 a cell. `centre`, `radius`: a sphere around all discs and rays' origins.
  RayGrid(std::span<const Piece> pieces, const Vec3d& centre, double radius, const RayGridSettings& settings);

  /// Calls visit(piece) for each that crosses the disc from its front.
  void crossed(const OrientedDisc& disc, const std::function<void(std::uint32_t)>& visit) const;

  std::size_t patches() const { return patches_.size(); }

 private:
  /// Directions within `angle` of `way`.
  struct Patch {
    Vec3d way, across, up;  // orthonormal
    double sine, tangent;   // of the angle
    double half;            // m, of the grid's side
  };
  /// Of the line: its direction and moment about the sphere's centre.
  struct Line {
    Vec3d way, moment;
    std::uint32_t piece;
  };
  struct Edge {
    Vec3d way, moment;
  };

  void make_patches();
  std::uint32_t patch_of(const Vec3d& way) const;
  std::size_t cell_of(const Patch& patch, double x, double y) const;
  int column_of(const Patch& patch, double x) const;
  void search(std::size_t patch, const OrientedDisc& disc, std::span<const Edge> edges,
              const std::function<void(std::uint32_t)>& visit) const;

  const RayGridSettings settings_;
  const Vec3d centre_;
  const double radius_;
  std::span<const Piece> pieces_;
  std::vector<std::uint32_t> first_patch_;  // of each ring, and their number
  std::vector<Patch> patches_;
  std::vector<std::uint32_t> first_line_;  // of each cell, patch by patch, and their number
  std::vector<Line> lines_;                // cell by cell
};

}  // namespace radfarm::bench
