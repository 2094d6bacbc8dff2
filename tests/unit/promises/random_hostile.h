#pragma once

#include <span>
#include <vector>

#include "tests/unit/promises/random_parts.h"

/// Parts of the family "hostile", whose scenes are chosen so that a pilot reports too small an error.
namespace volumen::tests::hostile {

/// A kind of scene. `make` sets the volume and the scene of a case.
struct Kind {
  const char* name;
  void (*make)(Chance& chance, RandomCase& c);
};
/// Returns scenes with narrow peaks, steps and combs in the curve or in the gradient opacity.
std::span<const Kind> curveKinds();
/// Returns scenes whose values repeat along rays with the period of a plain step.
std::span<const Kind> resonantKinds();
/// Returns lattices, sponges, rods and other volumes with detail everywhere.
std::span<const Kind> volumeKinds();
/// Returns scenes with extreme light, cameras and unit distances.
std::span<const Kind> lightKinds();
/// Returns large pictures whose error is in a small part.
std::span<const Kind> blindSpotKinds();

// Values at positions in voxel space, 0 .. 1 unless stated otherwise.

/// Returns plates of `thick` voxels with soft edges. `normal` may have any length.
ValueAt plates(glm::dvec3 normal, double period, double thick);
/// Returns plates, wires or dots about a voxel thick in any direction, with periods of 2 to 12 voxels.
ValueAt anyLattice(Chance& chance);
/// Returns a sum of `count` waves in random directions with periods of about `period` voxels.
ValueAt ripples(Chance& chance, double period, int count);
/// Returns a smooth hill that is 1 in the middle and 0 at the faces.
ValueAt hill(glm::ivec3 size);
/// Returns `count` solid balls at random places with radii of 1.5 to 4 voxels.
ValueAt sponge(Chance& chance, glm::ivec3 size, int count);
/// Returns bars between -1 and +1 in a network like trabecular bone.
ValueAt network(Chance& chance);
/// Returns values like those of a CT in HU: air, smooth tissue, bone, and noise of this amplitude.
ValueAt ctValues(Chance& chance, glm::ivec3 size, double noiseHu);

// Cameras, curves and volumes that several kinds share.

/// Returns a unit vector along an axis, along small whole numbers of voxels, or any.
glm::dvec3 anyDirection(Chance& chance);
/// Returns the direction itself or one that is up to 0.1 off.
glm::dvec3 nearly(Chance& chance, glm::dvec3 direction);
/// Sets a parallel camera along `direction`. `share` of the box's height fills the picture.
void lookAlong(Chance& chance, RandomCase& c, glm::dvec3 direction, double share = 0.8);
/// Places a wide perspective camera inside the box.
void lookFromInside(Chance& chance, RandomCase& c);
/// Sets the unit distance so that matter of this opacity has the optical depth `depth` across the box.
void setDepth(RandomCase& c, double opacity, double depth);
/// Returns `count` points at even distances over a range, which are in turn like `even` and `odd`.
std::vector<CurvePoint> comb(ValueRange range, int count, CurvePoint even, CurvePoint odd);
/// Returns a comb of colours, opacities or both. Opacities do not exceed `most`.
std::vector<CurvePoint> anyComb(Chance& chance, ValueRange range, int count, double most);
/// Sets up a CT of 24 to 96 voxels an edge.
void aroundCt(Chance& chance, RandomCase& c, double noiseHu);

}  // namespace volumen::tests::hostile
