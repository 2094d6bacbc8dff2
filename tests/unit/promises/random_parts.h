#pragma once

#include <functional>
#include <vector>

#include "tests/fixtures/chance.h"
#include "tests/unit/promises/random_cases.h"

namespace volumen::tests {

/// Parts of random cases. The families share those that do not depend on the intended difficulty.

/// Returns a box of 8 .. 40 voxels an edge cut from a real study, and a scene for it. It has no volume if the
/// data are absent.
RandomCase randomPiece(Chance chance);
/// Returns a volume of 1 .. 24 voxels an edge, and a scene for it.
RandomCase randomHard(Chance chance);
/// Returns a scene of a kind chosen to break levels, in a volume of 10 .. 64 voxels an edge.
RandomCase randomAttack(Chance chance);
/// Returns a scene of a kind chosen so that pilots report too small an error, in a volume of 10 .. 96 voxels
/// an edge.
RandomCase randomHostile(Chance chance);
/// Returns a lattice under a curve of two points that is about as steep as the limit for plain steps.
RandomCase randomLattice(Chance& chance);
/// Returns a unit vector along whole numbers of voxels, at most eight an axis.
glm::dvec3 directionOfSmallNumbers(Chance& chance);

/// Returns the radius of the sphere around the volume's box, in mm.
double radiusOf(const VoxelGeometry& geometry);
/// Returns the edge of a cube of a voxel's volume, in mm.
double voxelEdgeOf(const VoxelGeometry& geometry);

/// Returns the value at `share` of a range.
float valueIn(ValueRange range, double share);
/// Returns `count` random shares of 0 .. 1, ascending.
std::vector<double> randomShares(Chance& chance, int count);
/// Returns the value of a random voxel.
float valueOfAnyVoxel(Chance& chance, const Volume& volume);

/// Returns a camera in random direction and projection. One in three looks along an axis of the patient or of
/// the grid. The whole box or a part of it is in view, or the eye is inside.
Camera randomCamera(Chance& chance, const VoxelGeometry& geometry);
/// Adds a clip box in a quarter of all cases, and planes in a quarter.
Clip randomClip(Chance& chance, const VoxelGeometry& geometry);
/// Sets light on or off, one side or both, and lights in both spaces with intensities up to `mostIntensity`.
void addRandomLight(Chance& chance, Scene& scene, int mostLights, double mostIntensity);
/// Returns a rise, a band, a step or random points with equal probability. Gradients are about `perMm` a mm.
std::vector<GradientOpacityPoint> randomGradientOpacity(Chance& chance, double perMm);
/// Returns composite in five of eight cases.
Mode randomMode(Chance& chance);
/// Returns a window of `width` about values that the mode shows of a range.
Window windowAbout(Chance& chance, Mode mode, ValueRange range, double width);
Background randomBackground(Chance& chance);
glm::ivec2 randomPictureSize(Chance& chance);

/// The value at a position in voxel space.
using ValueAt = std::function<double(glm::dvec3 pVoxel)>;
glm::ivec3 anySize(Chance& chance, int least = 10, int most = 28);
/// Returns the grid of a spacing in mm.
glm::dmat3 spacing(glm::dvec3 mm);
/// Returns a ball in 0 .. 1 whose edge is about two voxels wide.
ValueAt ball(glm::ivec3 size, double share = 0.3);
/// Returns independent random values in 0 .. 1, a new one for each call.
ValueAt noise(Chance& chance);

ValueRange rangeOf(const RandomCase& c);
/// Returns a curve of 2 to 6 points over the values of a volume, with at least one visible point.
std::vector<CurvePoint> anyCurve(Chance& chance, ValueRange range);
/// Returns a ramp from 0 to `opacity` that begins at `start` and is `wide` wide (shares of the range).
std::vector<CurvePoint> ramp(Chance& chance, ValueRange range, double start, double wide, double opacity);
/// Returns a triangular band about `middle`, `wide` to each side (shares of the range).
std::vector<CurvePoint> band(Chance& chance, ValueRange range, double middle, double wide, double opacity);
/// Sets up the scene that all kinds of scenes start from and then modify.
void around(Chance& chance, RandomCase& c, VolumePtr volume);

}  // namespace volumen::tests
