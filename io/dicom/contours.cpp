#include "io/contours.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "io/dicom/derived_object.h"
#include "io/dicom/isolated_file.h"
#include "io/worker/object_fields.h"

namespace volumen {
namespace dicom {
namespace {

using Scope = DataSet::Scope;

constexpr std::pair<const char*, Contour::Type> types[] = {
    {"POINT", Contour::Type::point},
    {"OPEN_PLANAR", Contour::Type::openPlanar},
    {"OPEN_NONPLANAR", Contour::Type::openNonplanar},
    {"CLOSED_PLANAR", Contour::Type::closedPlanar},
    {"CLOSEDPLANAR_XOR", Contour::Type::closedPlanarXor}};

/// Reads a structure set.
class ContourReader {
 public:
  explicit ContourReader(const DataSet& data) : data_(data) {}

  StructureSet run() {
    const Scope root = data_.root();
    out_.label = data_.utf8(0x30060002, root);
    out_.name = data_.utf8(0x30060004, root);
    out_.description = data_.utf8(0x30060006, root);
    for (const Scope item : data_.items(0x30060020, root)) readRegion(item);
    for (const Scope item : data_.items(0x30060080, root))
      if (RegionOfInterest* region = regionOf(item)) {
        region->type = data_.utf8(0x300600a4, item);
        region->code = codeAt(data_, 0x30060086, item);
      }
    for (const Scope item : data_.items(0x30060039, root)) {
      RegionOfInterest* region = regionOf(item);
      if (region)
        readContours(item, *region);
      else
        leaveOut("Contours of a region that the structure set does not name");
    }
    return std::move(out_);
  }

 private:
  void leaveOut(const std::string& what) { out_.warnings.push_back(what + " are left out."); }

  std::optional<int> numberAt(std::uint32_t tag, Scope item) const {
    const auto number = data_.number(tag, item);
    if (!number || std::abs(*number) > 1e9) return {};
    return int(*number);
  }

  void readRegion(Scope item) {
    const auto number = numberAt(0x30060022, item);
    if (!number || !byNumber_.emplace(*number, out_.regions.size()).second)
      return leaveOut("A region without a number of its own and its contours");
    RegionOfInterest region;
    region.number = *number;
    region.name = data_.utf8(0x30060026, item);
    region.description = data_.utf8(0x30060028, item);
    region.algorithm = data_.utf8(0x30060036, item);
    region.frameOfReferenceUid = data_.text(0x30060024, item);
    out_.regions.push_back(std::move(region));
  }

  /// Returns the region that an item names by ReferencedROINumber, or null.
  RegionOfInterest* regionOf(Scope item) {
    const auto number = numberAt(0x30060084, item);
    const auto found = number ? byNumber_.find(*number) : byNumber_.end();
    return found == byNumber_.end() ? nullptr : &out_.regions[found->second];
  }

  void readContours(Scope item, RegionOfInterest& region) {
    if (const auto rgb = data_.numbers(0x3006002a, item); rgb && rgb->size() == 3) {
      const auto part = [&](int n) { return std::uint8_t(std::clamp((*rgb)[std::size_t(n)], 0.0, 255.0)); };
      region.colour = glm::u8vec3(part(0), part(1), part(2));
    }
    std::size_t damaged = 0;
    for (const Scope contour : data_.items(0x30060040, item))
      if (auto read = readContour(contour))
        region.contours.push_back(std::move(*read));
      else
        ++damaged;
    if (damaged > 0)
      leaveOut(std::to_string(damaged) + " contours of \"" + region.name +
               "\" without a known type or without three numbers a point, within 10 km");
  }

  std::optional<Contour> readContour(Scope item) const {
    const std::string name = data_.text(0x30060042, item);
    const auto type = std::ranges::find(types, name, [](const auto& t) { return std::string_view(t.first); });
    const auto numbers = data_.numbers(0x30060050, item);
    constexpr double farthest = 1e7;
    if (type == std::end(types) || !numbers || numbers->size() % 3 != 0 ||
        std::ranges::any_of(*numbers, [](double x) { return std::abs(x) > farthest; }))
      return {};
    Contour contour;
    contour.type = type->second;
    contour.points.reserve(numbers->size() / 3);
    for (std::size_t n = 0; n < numbers->size(); n += 3)
      contour.points.emplace_back((*numbers)[n], (*numbers)[n + 1], (*numbers)[n + 2]);
    contour.pictures = readPictures(data_, data_.contents(0x30060016, item));
    return contour;
  }

  const DataSet& data_;
  StructureSet out_;
  std::unordered_map<int, std::size_t> byNumber_;
};

}  // namespace
}  // namespace dicom

namespace {

Result<StructureSet> loadContoursHere(const std::string& path) {
  return dicom::loadObject<StructureSet>(path, DerivedKind::contours,
                                         [](const dicom::InspectedFile&, const dicom::DataSet& data) {
                                           return Result<StructureSet>(dicom::ContourReader(data).run());
                                         });
}

}  // namespace

Result<StructureSet> loadContours(const std::string& path) {
  return dicom::isolatedFile<loadContoursHere>(path, 0);
}

double areaOf(const Contour& contour) {
  const bool closed =
      contour.type == Contour::Type::closedPlanar || contour.type == Contour::Type::closedPlanarXor;
  glm::dvec3 twice(0);
  if (!closed || contour.points.empty()) return 0;
  const glm::dvec3 first = contour.points.front();
  for (std::size_t n = 1; n + 1 < contour.points.size(); ++n)
    twice += glm::cross(contour.points[n] - first, contour.points[n + 1] - first);
  return glm::length(twice) / 2;
}

const char* typeName(Contour::Type type) {
  constexpr const char* names[] = {"point", "openPlanar", "openNonplanar", "closedPlanar", "closedPlanarXor"};
  return names[int(type)];
}

}  // namespace volumen
