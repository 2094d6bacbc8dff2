#include "viewer/register/rigid_registration.h"

#include <itkEuler3DTransform.h>
#include <itkImageRegistrationMethodv4.h>
#include <itkMattesMutualInformationImageToImageMetricv4.h>
#include <itkMultiThreaderBase.h>
#include <itkRegularStepGradientDescentOptimizerv4.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "viewer/register/sampled_grid.h"

namespace volumen {

namespace {

constexpr double gridMm = 2;      // grid of the comparison
constexpr int mostSamples = 160;  // most samples along an axis
constexpr int fewestSamples = 8;  // fewest samples along an axis
constexpr int bins = 50;          // bins of grey values for each volume
constexpr int iterations = 200;   // most iterations per level
constexpr double firstStepMm = 2, lastStepMm = 0.002;
constexpr double leastOverlap = 0.2;  // least overlap as a fraction of the smaller volume
constexpr std::size_t levels = 3;
constexpr std::array<unsigned, levels> shrink{4, 2, 1};
constexpr std::array<double, levels> sigmaMm{4, 2, 0}, sampled{0.8, 0.4, 0.15};

using GreyImage = itk::Image<float, 3>;
using Transform = itk::Euler3DTransform<double>;
using Metric = itk::MattesMutualInformationImageToImageMetricv4<GreyImage, GreyImage>;
using Optimizer = itk::RegularStepGradientDescentOptimizerv4<double>;
using Registration = itk::ImageRegistrationMethodv4<GreyImage, GreyImage, Transform>;

GreyImage::Pointer imageOf(const SampledGrid& grid) {
  const VoxelGeometry& geometry = grid.geometry;
  const glm::dvec3 spacing = geometry.spacing();
  auto image = GreyImage::New();
  GreyImage::SizeType size;
  GreyImage::DirectionType direction;
  for (int axis = 0; axis < 3; ++axis) {
    size[unsigned(axis)] = itk::SizeValueType(geometry.size[axis]);
    for (int row = 0; row < 3; ++row)
      direction[unsigned(row)][unsigned(axis)] = geometry.patientFromVoxelStep[axis][row] / spacing[axis];
  }
  image->SetRegions(GreyImage::RegionType(size));
  image->SetSpacing(&spacing[0]);
  image->SetOrigin(&geometry.origin[0]);
  image->SetDirection(direction);
  image->Allocate();
  std::ranges::copy(grid.values, image->GetBufferPointer());
  return image;
}

itk::Point<double, 3> pointOf(glm::dvec3 p) {
  itk::Point<double, 3> point;
  for (int axis = 0; axis < 3; ++axis) point[unsigned(axis)] = p[axis];
  return point;
}

// Centroid of the values above the darkest, and their RMS distance from it, mm.
struct Mass {
  glm::dvec3 middle;
  double radius;
};

Mass massOf(const SampledGrid& grid) {
  const float least = *std::ranges::min_element(grid.values);
  glm::dvec3 sum(0);
  double mass = 0, squares = 0;
  const glm::ivec3 n = grid.geometry.size;
  for (std::size_t at = 0; at < grid.values.size(); ++at) {
    const auto row = at / std::size_t(n.x);
    const double weight = double(grid.values[at]) - least;
    const glm::dvec3 p = grid.geometry.patientFromVoxel(
        glm::dvec3(at % std::size_t(n.x), row % std::size_t(n.y), row / std::size_t(n.y)));
    sum += weight * p;
    squares += weight * glm::dot(p, p);
    mass += weight;
  }
  const glm::dvec3 middle = sum / mass;
  return {middle, std::sqrt(std::max(1.0, squares / mass - glm::dot(middle, middle)))};
}

Transform::Pointer shiftedBy(glm::dvec3 centre, glm::dvec3 shift) {
  auto transform = Transform::New();
  transform->SetCenter(pointOf(centre));
  Transform::OutputVectorType vector;
  for (int axis = 0; axis < 3; ++axis) vector[unsigned(axis)] = shift[axis];
  transform->SetTranslation(vector);
  return transform;
}

Metric::Pointer makeMetric() {
  auto metric = Metric::New();
  metric->SetNumberOfHistogramBins(bins);
  metric->SetUseMovingImageGradientFilter(false);
  metric->SetUseFixedImageGradientFilter(false);
  // Sums over several threads differ in their last digits from run to run.
  metric->SetMaximumNumberOfWorkUnits(1);
  return metric;
}

// Returns the negative mutual information: smaller is better, and the maximum means no overlap.
double disagreement(GreyImage* fixed, GreyImage* moving, Transform* transform) {
  const Metric::Pointer metric = makeMetric();
  metric->SetFixedImage(fixed);
  metric->SetMovingImage(moving);
  metric->SetMovingTransform(transform);
  try {
    metric->Initialize();
    return metric->GetValue();
  } catch (const itk::ExceptionObject&) {
    return std::numeric_limits<double>::max();
  }
}

// Returns the best of three starts: positions as in the files, aligned centres, aligned centroids.
Transform::Pointer firstGuess(const SampledGrid& fixed, const SampledGrid& moving, GreyImage* fixedImage,
                              GreyImage* movingImage) {
  const glm::dvec3 centre = massOf(fixed).middle;
  Transform::Pointer best;
  double least = std::numeric_limits<double>::infinity();
  for (const glm::dvec3 shift :
       {glm::dvec3(0), moving.geometry.centre() - fixed.geometry.centre(), massOf(moving).middle - centre}) {
    const Transform::Pointer guess = shiftedBy(centre, shift);
    const double value = disagreement(fixedImage, movingImage, guess);
    if (value < least) least = value, best = guess;
  }
  return best;
}

// Reports the progress and stops the optimizer by an exception when cancelled.
void watch(Optimizer* optimizer, Registration* registration, const CancelToken& cancel) {
  optimizer->AddObserver(itk::IterationEvent(), [=](const itk::EventObject&) {
    if (cancel.cancelled()) throw itk::ProcessAborted(__FILE__, __LINE__);
    const double level = double(registration->GetCurrentLevel());
    cancel.setDone((level + double(optimizer->GetCurrentIteration()) / iterations) / double(levels));
  });
}

Rigid rigidOf(const Transform& transform) {
  Rigid rigid;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rigid.rotation[column][row] = transform.GetMatrix()[unsigned(row)][unsigned(column)];
    rigid.translation[row] = transform.GetOffset()[unsigned(row)];
  }
  return rigid;
}

Rigid optimised(GreyImage* fixed, GreyImage* moving, Transform* transform, double radiusMm,
                const CancelToken& cancel) {
  const Metric::Pointer metric = makeMetric();
  auto optimizer = Optimizer::New();
  // Angles and lengths count by how far they move visible matter, in mm.
  Optimizer::ScalesType scales(6);
  for (unsigned n = 0; n < 6; ++n) scales[n] = n < 3 ? radiusMm * radiusMm : 1;
  optimizer->SetScales(scales);
  optimizer->SetDoEstimateScales(false);
  optimizer->SetDoEstimateLearningRateOnce(false);
  optimizer->SetLearningRate(firstStepMm);
  optimizer->SetMinimumStepLength(lastStepMm);
  optimizer->SetRelaxationFactor(0.8);
  optimizer->SetNumberOfIterations(iterations);
  optimizer->SetReturnBestParametersAndValue(true);
  optimizer->SetNumberOfWorkUnits(1);
  auto registration = Registration::New();
  registration->SetFixedImage(fixed);
  registration->SetMovingImage(moving);
  registration->SetMetric(metric);
  registration->SetOptimizer(optimizer);
  registration->SetInitialTransform(transform);
  registration->InPlaceOn();
  registration->SetNumberOfLevels(levels);
  Registration::ShrinkFactorsArrayType shrinkOf(levels);
  Registration::SmoothingSigmasArrayType sigmaOf(levels);
  Registration::MetricSamplingPercentageArrayType sampledOf(levels);
  for (std::size_t level = 0; level < levels; ++level)
    shrinkOf[level] = shrink[level], sigmaOf[level] = sigmaMm[level], sampledOf[level] = sampled[level];
  registration->SetShrinkFactorsPerLevel(shrinkOf);
  registration->SetSmoothingSigmasPerLevel(sigmaOf);
  registration->SetSmoothingSigmasAreSpecifiedInPhysicalUnits(true);
  registration->SetMetricSamplingStrategy(Registration::MetricSamplingStrategyEnum::REGULAR);
  registration->SetMetricSamplingPercentagePerLevel(sampledOf);
  registration->MetricSamplingReinitializeSeed(20261124);
  watch(optimizer, registration, cancel);
  registration->Update();
  return rigidOf(*registration->GetTransform());
}

// Returns the fraction of samples of one grid that lie within the other.
double shareWithin(const VoxelGeometry& grid, const Rigid& toOther, const VoxelGeometry& other) {
  constexpr int steps = 12;
  int inside = 0;
  for (int n = 0; n < steps * steps * steps; ++n) {
    const glm::dvec3 part =
        (glm::dvec3(n % steps, n / steps % steps, n / steps / steps) + 0.5) / double(steps);
    const glm::dvec3 p = grid.patientFromVoxel(part * glm::dvec3(grid.size) - 0.5);
    const glm::dvec3 x = other.voxelFromPatient(toOther(p)) + 0.5;
    inside +=
        glm::all(glm::greaterThan(x, glm::dvec3(0))) && glm::all(glm::lessThan(x, glm::dvec3(other.size)));
  }
  return double(inside) / (steps * steps * steps);
}

std::string whyNot(const char* which, const SampledGrid& grid) {
  const std::string start = std::string("Cannot register: the ") + which + " series ";
  if (!grid.geometry.calibrated) return start + "is not calibrated, its size in mm is not known.";
  const glm::ivec3 n = grid.geometry.size;
  if (std::min({n.x, n.y, n.z}) < fewestSamples)
    return start + "is too small: " + std::to_string(fewestSamples) + " slices and 16 mm are needed.";
  const auto [least, most] = std::ranges::minmax(grid.values);
  if (!(most > least)) return start + "has the same value everywhere.";
  return {};
}

}  // namespace

Result<Rigid> registerRigidly(const Volume& fixed, const Volume& moving, const CancelToken& cancel) {
  const Error cancelled{"Registration cancelled."};
  const SampledGrid from = sampledGrid(fixed, gridMm, mostSamples, cancel);
  const SampledGrid to = sampledGrid(moving, gridMm, mostSamples, cancel);
  if (cancel.cancelled()) return cancelled;
  for (const auto& [which, grid] : {std::pair("first", &from), std::pair("second", &to)})
    if (const std::string why = whyNot(which, *grid); !why.empty()) return Error{why};
  itk::Object::SetGlobalWarningDisplay(false);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  try {
    const GreyImage::Pointer fixedImage = imageOf(from), movingImage = imageOf(to);
    const Transform::Pointer transform = firstGuess(from, to, fixedImage, movingImage);
    const Rigid found = optimised(fixedImage, movingImage, transform, massOf(from).radius, cancel);
    const double overlap = std::max(shareWithin(from.geometry, found, to.geometry),
                                    shareWithin(to.geometry, found.inverse(), from.geometry));
    if (overlap < leastOverlap) return Error{"Cannot register: the two series hardly overlap."};
    return found;
  } catch (const itk::ProcessAborted&) {
    return cancelled;
  } catch (const itk::ExceptionObject& problem) {
    return Error{"Cannot register: " + std::string(problem.GetDescription())};
  }
}

}  // namespace volumen
