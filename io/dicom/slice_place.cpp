#include "io/dicom/slice_place.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen::dicom {
namespace {

constexpr std::uint32_t planeOrientation = 0x00209116, planeOrientationInVolume = 0x0020930f;

std::optional<glm::dvec3> positionOf(const std::vector<double>& v) {
  if (v.size() < 3) return {};
  return glm::dvec3(v[0], v[1], v[2]);
}

/// Returns orthonormal vectors, or nothing if the file's are off by more than 1 %.
std::optional<Orientation> orientationOf(const std::vector<double>& v, const std::string& name,
                                         FileHeader& header) {
  if (v.size() < 6) return {};
  const glm::dvec3 row(v[0], v[1], v[2]), column(v[3], v[4], v[5]);
  const double off = std::max(
      {std::abs(glm::length(row) - 1), std::abs(glm::length(column) - 1), std::abs(glm::dot(row, column))});
  if (!(off <= 0.01)) {
    warnOnce(header, "its " + name + " is not a pair of unit vectors at right angles and is not used");
    return {};
  }
  if (off > 1e-3) warnOnce(header, "its " + name + " was made exactly orthonormal");
  Orientation o{glm::normalize(row), {}};
  o.column = glm::normalize(column - glm::dot(column, o.row) * o.row);
  return o;
}

std::optional<glm::dvec3> readPosition(const DataSet& data, DataSet::Scope scope) {
  return positionOf(data.numbers(0x00200032, scope).value_or(std::vector<double>()));
}

std::optional<Orientation> readOrientation(const DataSet& data, DataSet::Scope scope, FileHeader& header) {
  const auto v = data.numbers(0x00200037, scope);
  return orientationOf(v.value_or(std::vector<double>()), "ImageOrientationPatient", header);
}

}  // namespace

void warnOnce(FileHeader& header, const std::string& sentence) {
  if (std::ranges::find(header.warnings, sentence) == header.warnings.end())
    header.warnings.push_back(sentence);
}

void readPlace(const DataSet& data, DataSet::Scope scope, Slice& slice, FileHeader& header) {
  if (const auto position = readPosition(data, scope)) slice.position = position;
  if (const auto orientation = readOrientation(data, scope, header)) slice.orientation = orientation;
}

void readPlace(const DataSet& data, const FrameScopes& at, Slice& slice, FileHeader& header) {
  slice.position = readPosition(data, at.ofGroupAlone(planePosition));
  slice.orientation = readOrientation(data, at.of(planeOrientation), header);
  if (slice.position && slice.orientation) return;
  const auto position = positionOf(data.reals(0x00209301, at.ofGroupAlone(planePositionInVolume)));
  const auto orientation = orientationOf(data.reals(0x00209302, at.ofGroupAlone(planeOrientationInVolume)),
                                         "ImageOrientationVolume", header);
  if (!position || !orientation) return;
  slice.position = position;
  slice.orientation = orientation;
  slice.ofTransducer = true;
}

}  // namespace volumen::dicom
