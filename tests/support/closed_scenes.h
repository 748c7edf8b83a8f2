#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "radiosity/solve.h"

namespace radfarm::test {

/// A scene of which the radiosity solver's answer is known.
struct ClosedForm {
  std::string form;         // of ALGORITHMS.md 3.1: "O1"
  std::string name;
  Scene scene;
  double closed_form = 0;   // of the ideal shape
  double truth = 0;         // of the scene's own triangles, where known better
  double truth_error = 0;   // relative: what `truth` leaves out
  std::function<double(const World&, const RadiositySolution&)> answer{};
  /// Where the radiosity is the same everywhere: its relative root mean square deviation over triangles. May be empty.
  std::function<double(const World&, const RadiositySolution&)> unevenness{};
};

/// How the light comes to the receiver: sent by an emitter (direct light), or reflected by a surface that is lit evenly (over links).
enum class Sent { kEmitted, kReflected };

ClosedForm parallel_plates(double a, double b, double gap, Sent sent);                  // O1: form factor
ClosedForm corner(double width, double height, double edge, Sent sent);                 // O2: form factor, floor to wall
ClosedForm discs(double r1, double r2, double gap, Sent sent);                          // O3: form factor
enum class Furnace { kBox, kSphere, kCluttered };
ClosedForm furnace(Furnace shape, float reflectance);                                   // O9: radiosity, exitance 1
ClosedForm integrating_sphere(float reflectance);                                       // O10: radiosity of the dark wall
ClosedForm dome_over_disc(float reflectance);                                           // O11: radiosity of the dome
ClosedForm concentric_spheres(float reflectance);                                       // O12: radiosity of the outer one
ClosedForm wide_plates(float reflectance);                                              // O13: radiosity of the dark plate
ClosedForm coloured_box();                                                              // O19: radiosity of the ceiling

/// What the front sides of a material send of reflected light, lm/m^2.
double reflected_exitance(const World& world, const RadiositySolution& solution, std::uint32_t material);

}  // namespace radfarm::test
