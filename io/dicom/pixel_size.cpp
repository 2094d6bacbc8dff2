#include "io/dicom/pixel_size.h"

#include <algorithm>
#include <cmath>

namespace volumen::dicom {
namespace {

constexpr std::uint32_t framePixelData = 0x00289443, xRayGeometry = 0x00189476;

bool isProjection(const std::string& modality) {
  constexpr const char* projections[] = {"CR", "DX", "MG", "IO", "PX", "XA", "RF", "RG"};
  return std::find(std::begin(projections), std::end(projections), modality) != std::end(projections);
}

/// Returns the magnification of the patient at the detector; 1 if unknown.
double magnification(const DataSet& data, const FrameScopes& at) {
  const DataSet::Scope root = data.root(), geometry = at.of(xRayGeometry);
  const auto number = [&](std::uint32_t tag) {
    const auto ofFrame = data.number(tag, geometry);
    return ofFrame ? ofFrame : data.number(tag, root);
  };
  const double stated = number(0x00181114).value_or(0);
  if (stated > 0) return std::max(1.0, stated);
  const double toDetector = number(0x00181110).value_or(0), toPatient = number(0x00181111).value_or(0);
  return toPatient > 0 ? std::max(1.0, toDetector / toPatient) : 1;
}

/// Returns a size at the detector, converted to the patient if the magnification is known.
PixelSize atDetector(glm::dvec2 mm, double factor) {
  if (factor > 1) return {mm / factor, PixelSizeKind::magnified};
  return {mm, PixelSizeKind::atDetector};
}

PixelSize projectionSize(const DataSet& data, const FrameScopes& at, std::optional<glm::dvec2> spacing,
                         glm::dvec2 detector) {
  const std::string type = data.text(0x00280a02, data.root());
  if (spacing && type == "GEOMETRY") return {*spacing, PixelSizeKind::magnified};
  if (spacing && type == "FIDUCIAL") return {*spacing, PixelSizeKind::calibrated};
  if (spacing && *spacing != detector) return {*spacing, PixelSizeKind::unstated};
  return atDetector(detector, magnification(data, at));
}

/// Reads origin and direction of a region's axes. A reference pixel counts from the region's corner. Its
/// value is 0 if none is given.
void readZeros(const DataSet& data, DataSet::Scope item, UltrasoundRegion& region) {
  struct Axis {
    std::uint32_t delta, pixel, value;
  };
  constexpr Axis axes[] = {{0x0018602c, 0x00186020, 0x00186028}, {0x0018602e, 0x00186022, 0x0018602a}};
  for (int a = 0; a < 2; ++a) {
    if (data.real(axes[a].delta, item).value_or(0) < 0) region.sign[a] = -1;
    const auto pixel = data.dword(axes[a].pixel, item);
    const double value = data.real(axes[a].value, item).value_or(0);
    if (!pixel || !(region.delta[a] > 0) || !std::isfinite(value)) continue;
    // Signed (PS3.3 C.8.5.5.1), as it may lie outside the region.
    region.zero[a] = region.from[a] + double(std::int32_t(*pixel)) - region.sign[a] * value / region.delta[a];
  }
}

}  // namespace

std::optional<glm::dvec2> readSpacing(const DataSet& data, std::uint32_t tag, DataSet::Scope scope) {
  const auto v = data.numbers(tag, scope);
  if (!v || v->size() < 2 || !((*v)[0] > 0) || !((*v)[1] > 0)) return {};
  return glm::dvec2((*v)[1], (*v)[0]);
}

PixelSize readPixelSize(const DataSet& data, const FrameScopes& at, const std::string& modality) {
  const auto spacing = readSpacing(data, 0x00280030, at.of(pixelMeasures));
  // Pixel measures are in the patient, also if reconstructed from projections (tomosynthesis).
  if (spacing && at.hasGroup(pixelMeasures)) return {*spacing, PixelSizeKind::patient};
  auto detector = readSpacing(data, 0x00181164, data.root());
  if (!detector) detector = readSpacing(data, 0x00181164, at.of(framePixelData));
  if (detector || (spacing && isProjection(modality)))
    return projectionSize(data, at, spacing, detector ? *detector : *spacing);
  if (spacing) return {*spacing, PixelSizeKind::patient};
  if (const auto film = readSpacing(data, 0x00182010, data.root())) return {*film, PixelSizeKind::filmScan};
  const auto shape = readSpacing(data, 0x00280034, data.root());
  return {shape ? glm::dvec2(1, shape->y / shape->x) : glm::dvec2(1), PixelSizeKind::unknown};
}

std::vector<UltrasoundRegion> readRegions(const DataSet& data) {
  std::vector<UltrasoundRegion> regions;
  for (const DataSet::Scope item : data.items(0x00186011, data.root())) {
    const auto edge = [&](std::uint32_t tag) {
      return int(std::min<std::uint32_t>(data.dword(tag, item).value_or(0), 65535));
    };
    const auto delta = [&](std::uint32_t tag) {
      const double d = std::abs(data.real(tag, item).value_or(0));
      return std::isfinite(d) ? d : 0;
    };
    UltrasoundRegion region;
    region.from = {edge(0x00186018), edge(0x0018601a)};
    region.to = {edge(0x0018601c), edge(0x0018601e)};
    region.unitX = data.word(0x00186024, item).value_or(0);
    region.unitY = data.word(0x00186026, item).value_or(0);
    region.delta = {delta(0x0018602c), delta(0x0018602e)};
    readZeros(data, item, region);
    regions.push_back(region);
  }
  return regions;
}

}  // namespace volumen::dicom
