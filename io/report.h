#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/study/derived_object.h"
#include "viewer/segment/code.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A property in a report: the name and the code of its value.
struct ReportProperty {
  Code name, value;
  bool operator==(const ReportProperty&) const = default;
};

/// A region or position in a report (PS3.3 C.18.6, C.18.9).
struct ReportShape {
  enum class Type { point, multipoint, polyline, polygon, circle, ellipse, ellipsoid } type = Type::point;
  bool inPatient = false;          ///< SCOORD3D: patient mm (LPS); else pixels of an image
  std::vector<glm::dvec3> points;  ///< pixels: z is 0; 0, 0 is the outer corner of the first pixel
  Code name;
  std::string frameOfReferenceUid;          ///< frame of reference of patient positions
  std::vector<ReferencedPicture> pictures;  ///< the image of the pixels, or the source of the selection
  bool operator==(const ReportShape&) const = default;
};

struct ReportMeasurement {
  Code name, unit;              ///< the unit's value is UCUM: "mm", "[hnsf'U]"
  std::optional<double> value;  ///< empty if the report has none
  std::vector<ReportProperty> properties;
  std::vector<ReportShape> shapes;  ///< the shapes it was inferred from
  bool operator==(const ReportMeasurement&) const = default;
};

/// A measurement group of TID 1500 (PS3.16 TID 1410, 1411, 1501).
struct MeasurementGroup {
  std::string trackingId, trackingUid;
  Code category, finding, site;             ///< empty if missing
  std::vector<ReportProperty> evaluations;  ///< all other codes: "Level of Significance"
  std::vector<ReportMeasurement> measurements;
  std::vector<ReportShape> shapes;
  std::vector<ReferencedPicture> pictures;  ///< sources and segmentations
  bool operator==(const MeasurementGroup&) const = default;
};

/// A structured report: its title and the measurement groups of TID 1500. Text is UTF-8.
struct Report {
  Code title;
  std::vector<MeasurementGroup> groups;
  std::vector<std::string> warnings;  ///< parts left out and why: sentences without its name
  bool operator==(const Report&) const = default;
};

/// A Key Object Selection document (PS3.16 TID 2010): key images and the reason for them.
struct KeyObjects {
  Code title;
  std::string text;                         ///< description
  std::vector<ReferencedPicture> pictures;  ///< the key images
  bool operator==(const KeyObjects&) const = default;
};

/// Reads a report or a key object document. The Error names the file and the reason.
Result<Report> loadReport(const std::string& path);
Result<KeyObjects> loadKeyObjects(const std::string& path);

/// Returns the type's name for scripts: "polyline".
const char* typeName(ReportShape::Type type);

}  // namespace volumen
