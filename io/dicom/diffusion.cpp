#include "io/dicom/diffusion.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "io/dicom/separators.h"

namespace volumen::dicom {
namespace {

/// GE's diffusion weight; `isOfShell` is false if it may be that of the strongest gradient of the series.
struct GeWeight {
  double b = 0;
  bool isOfShell = false;
};

std::optional<GeWeight> geWeight(const DataSet& data) {
  constexpr double offset = 1e9;  // marks the weight of a shell
  const auto tag = data.privateTag(0x0043, "GEMS_PARM_01", 0x39, data.root());
  const auto numbers = tag ? data.numbers(tag, data.root()) : std::nullopt;
  if (!numbers) return {};
  return GeWeight{std::trunc(std::fmod((*numbers)[0], 100000)), (*numbers)[0] >= offset};
}

/// Returns GE's direction along readout, phase encoding and slice.
std::optional<glm::dvec3> geDirection(const DataSet& data) {
  glm::dvec3 direction(0);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const auto tag = data.privateTag(0x0019, "GEMS_ACQU_01", 0xbb + axis, data.root());
    const auto along = tag ? data.number(tag, data.root()) : std::nullopt;
    if (!along) return {};
    direction[int(axis)] = *along;
  }
  return direction;
}

/// Turns a direction of GE to the patient. It is relative to the picture: its third component points against
/// the cross product of rows and columns, and the first two swap if the phase is encoded along the rows.
std::vector<double> inPatient(const glm::dvec3& ofGe, const DataSet& data) {
  const auto axes = data.numbers(0x00200037, data.root());
  const double length = glm::length(ofGe);
  if (!axes || axes->size() != 6 || !(length > 0)) return {};
  const glm::dvec3 row((*axes)[0], (*axes)[1], (*axes)[2]), column((*axes)[3], (*axes)[4], (*axes)[5]);
  const bool isAlongRows = data.text(0x00181312, data.root()) == "ROW";
  const glm::dvec3 g = (isAlongRows ? glm::dvec3(ofGe.y, -ofGe.x, ofGe.z) : ofGe) / length;
  const glm::dvec3 turned = g.x * row + g.y * column - g.z * glm::cross(row, column);
  return {turned.x + 0.0, turned.y + 0.0, turned.z + 0.0};  // no -0
}

/// Returns the weight of a gradient of GE. If it is shorter than 1, `b` is that of the strongest gradient of
/// the series, and the weight grows with the square of the length. Weights are multiples of 5.
double weightOfLength(double b, const DataSet& data) {
  constexpr double shortest = 0.03, longest = 0.97, step = 5;
  const auto direction = geDirection(data);
  const double length = direction ? glm::length(*direction) : 1;
  if (!(length > shortest && length < longest)) return b;
  return std::max(step, step * std::round(b * length * length / step));
}

std::string privateBValue(const DataSet& data) {
  if (const auto tag = data.privateTag(0x0019, "SIEMENS MR HEADER", 0x0c, data.root()))
    if (std::string b = numberText(data, tag, data.root()); !b.empty()) return b;
  if (const auto tag = data.privateTag(0x2001, "Philips Imaging DD 001", 0x03, data.root())) {
    const std::string bytes = data.raw(tag, data.root());
    float b = 0;
    if (bytes.size() == sizeof b) {
      std::memcpy(&b, bytes.data(), sizeof b);
      if (std::isfinite(b)) return realText(b);
    }
  }
  if (const auto weight = geWeight(data))
    return realText(weight->isOfShell ? weight->b : weightOfLength(weight->b, data));
  return {};
}

}  // namespace

std::string readBValue(const DataSet& data, const FrameScopes& at) {
  const auto b = data.real(0x00189087, at.of(mrDiffusionGroup));
  if (!b) return privateBValue(data);
  const auto weight = geWeight(data);
  const bool isNominal = weight && !weight->isOfShell && weight->b == *b;
  return realText(isNominal ? weightOfLength(*b, data) : *b);
}

std::string readGradientDirection(const DataSet& data, const FrameScopes& at) {
  const DataSet::Scope diffusion = at.of(mrDiffusionGroup);
  if (const auto items = data.items(0x00189076, diffusion); !items.empty())
    return data.raw(0x00189089, items[0]);
  std::string direction = data.raw(0x00189089, data.root());
  if (!direction.empty()) return direction;
  for (const double x : privateDirection(data)) direction += (direction.empty() ? "" : "\\") + realText(x);
  return direction;
}

std::vector<double> privateDirection(const DataSet& data) {
  const DataSet::Scope root = data.root();
  if (const auto tag = data.privateTag(0x0019, "SIEMENS MR HEADER", 0x0e, root))
    if (const auto direction = data.reals(tag, root); direction.size() == 3) return direction;
  const auto right = data.privateTag(0x2005, "Philips MR Imaging DD 001", 0xb0, root);
  std::vector<double> direction;
  for (std::uint32_t axis = 0; right && axis < 3; ++axis)
    if (const auto along = data.floats(right + axis, root); along.size() == 1) direction.push_back(along[0]);
  if (direction.size() == 3) return direction;
  const auto ofGe = geDirection(data);
  return ofGe ? inPatient(*ofGe, data) : std::vector<double>();
}

}  // namespace volumen::dicom
