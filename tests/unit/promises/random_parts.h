#pragma once

#include <vector>

#include "tests/fixtures/chance.h"
#include "tests/unit/promises/random_cases.h"

namespace volumen::tests {

/// A random case's parts. The families share what does not depend on how hard it is meant to be.

/// A box of 8 .. 40 voxels an edge out of a real study, and a scene for it; without a volume where the data
/// are absent.
RandomCase randomPiece(Chance chance);
/// A volume of 1 .. 24 voxels an edge, and a scene for it.
RandomCase randomHard(Chance chance);
/// A kind of scene that levels were attacked with, in a volume of 10 .. 64 voxels an edge.
RandomCase randomAttack(Chance chance);
/// A lattice under a curve of two points about as steep as plain steps are taken for.
RandomCase randomLattice(Chance& chance);
/// A unit vector along up to eight voxels an axis, or fewer.
glm::dvec3 directionOfSmallNumbers(Chance& chance);

/// Half the diagonal of the volume's box, mm.
double radiusOf(const VoxelGeometry& geometry);
/// The edge of a cube of a voxel's volume, mm.
double voxelEdgeOf(const VoxelGeometry& geometry);

/// A value `share` of the way through a range.
float valueIn(ValueRange range, double share);
/// `count` shares of 0 .. 1, ascending.
std::vector<double> randomShares(Chance& chance, int count);
/// The value of a voxel.
float valueOfAnyVoxel(Chance& chance, const Volume& volume);

/// From every side, every third along an axis of the patient or of the grid; in either projection; the whole
/// box in view or a part of it, or the eye within.
Camera randomCamera(Chance& chance, const VoxelGeometry& geometry);
/// Boxes in a quarter of all cases, planes in a quarter.
Clip randomClip(Chance& chance, const VoxelGeometry& geometry);
/// Lit or not, one side or both, lights of both spaces, each of an intensity up to `mostIntensity`.
void addRandomLight(Chance& chance, Scene& scene, int mostLights, double mostIntensity);
/// A rise, a band, or points at random, a quarter of them a step, over gradients of about `perMm` a mm.
std::vector<GradientOpacityPoint> randomGradientOpacity(Chance& chance, double perMm);
/// Five in eight composite.
Mode randomMode(Chance& chance);
/// `width` wide, about where the mode finds values of a range.
Window windowAbout(Chance& chance, Mode mode, ValueRange range, double width);
Background randomBackground(Chance& chance);
glm::ivec2 randomPictureSize(Chance& chance);

}  // namespace volumen::tests
