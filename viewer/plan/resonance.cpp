#include "viewer/plan/resonance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace volumen {

namespace {

constexpr int finestWave = 20;         // finer ones are weaker than 1/400
constexpr double samplesOfARay = 200;  // samples of a long ray; a drift of one period over it averages out

// Above this, lattices violated levels whose steps keep their promise otherwise (tests/unit/promises,
// TestEvenSteps::noDirectionResonates).
constexpr double mostResonance = 0.3;

// The same of steps that are tried before they are taken.
constexpr double mostToTry = 0.5;

// A shorter step is not worth less resonance than this.
constexpr double littleResonance = 0.05;

// Step lengths whose continued fractions end in ones: successive steps visit all places of the cells about
// equally often. Longer ones would be too close to a whole voxel.
constexpr double evenlySpread[] = {0.8490, 0.7835, 0.7236, 0.6180, 0.5802, 0.5607, 0.4393, 0.4198,
                                   0.3820, 0.3593, 0.3109, 0.3052, 0.2957, 0.2764, 0.2338, 0.2282,
                                   0.2165, 0.1895, 0.1780, 0.1747, 0.1513, 0.1315};

struct Wave {
  glm::dvec3 m;
  double power;
};

// Half of all waves: the opposite of each is the same.
std::vector<Wave> makeWaves() {
  std::vector<Wave> waves;
  for (int x = -finestWave; x <= finestWave; ++x)
    for (int y = -finestWave; y <= finestWave; ++y)
      for (int z = 0; z <= finestWave; ++z) {
        const int product = std::max(1, std::abs(x)) * std::max(1, std::abs(y)) * std::max(1, z);
        const bool isOpposite = z == 0 && (y < 0 || (y == 0 && x <= 0));
        if (product <= finestWave && !isOpposite) waves.push_back({{x, y, z}, 1.0 / (product * product)});
      }
  return waves;
}

// Returns the part of a wave that remains in the mean of a ray's samples, at `periods` per step.
double leftOf(double periods) {
  if (std::abs(periods) < 0.5) return 0;  // resolved by the steps
  const double off = std::abs(periods - std::round(periods)) * samplesOfARay;
  return std::min(1.0, 1 / (std::numbers::pi * off));  // envelope of a sinc
}

// Returns the resonance with patterns of two to eight voxels, relative to the whole error of such steps.
double resonance(double stepVoxels, glm::dvec3 alongVoxel) {
  static const std::vector<Wave> waves = makeWaves();
  double most = 0;
  for (int period = 2; period <= 8; ++period) {
    double sum = 0;
    for (const Wave& wave : waves) {
      const double left = leftOf(stepVoxels * glm::dot(alongVoxel, wave.m) / period);
      sum += wave.power * left * left;
    }
    most = std::max(most, sum);
  }
  return most / (stepVoxels * stepVoxels);
}

// Returns whether a step along an axis is within 2 % of one that meets all cells at the same few places.
bool meetsSamePlaces(double step) {
  for (double few : {1.0, 3.0 / 4, 2.0 / 3, 1.0 / 2, 1.0 / 3, 1.0 / 4})
    if (std::abs(step / few - 1) <= 0.02) return true;
  return false;
}

// Returns whether this holds along any axis.
bool meetsSamePlaces(double stepVoxels, glm::dvec3 alongVoxel) {
  const glm::dvec3 step = stepVoxels * glm::abs(alongVoxel);
  return meetsSamePlaces(step.x) || meetsSamePlaces(step.y) || meetsSamePlaces(step.z);
}

}  // namespace

glm::dvec3 alongVoxelOf(const Camera& camera, const VoxelGeometry& geometry) {
  return glm::normalize(geometry.voxelFromPatientStep() * glm::normalize(camera.direction));
}

std::optional<double> stepWithoutResonance(glm::dvec3 alongVoxel, double most, double least) {
  constexpr double shorter = 0.985;
  std::optional<double> best;
  double leastResonance = mostResonance;
  for (double step = most; step >= least && leastResonance > littleResonance; step *= shorter) {
    if (meetsSamePlaces(step, alongVoxel)) continue;
    const double found = resonance(step, alongVoxel);
    if (found > leastResonance) continue;
    leastResonance = found;
    best = step;
  }
  return best;
}

std::optional<double> evenlySpreadStep(glm::dvec3 alongVoxel, double most, double least) {
  for (double step : evenlySpread)
    if (step <= most && step >= least && !meetsSamePlaces(step, alongVoxel) &&
        resonance(step, alongVoxel) <= mostToTry)
      return step;
  return {};
}

}  // namespace volumen
