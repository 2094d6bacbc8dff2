#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/study/derived_object.h"
#include "viewer/segment/code.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A statement of a report: a name and the code that is said of it.
struct ReportProperty {
  Code name, value;
};

/// A region or position that a report speaks of (PS3.3 C.18.6, C.18.9).
struct ReportShape {
  enum class Type { point, multipoint, polyline, polygon, circle, ellipse, ellipsoid } type = Type::point;
  bool inPatient = false;          ///< SCOORD3D: patient mm (LPS); else pixels of a picture
  std::vector<glm::dvec3> points;  ///< in pixels z is 0 and 0, 0 the outer corner of the first pixel
  Code name;
  std::string frameOfReferenceUid;          ///< of positions in the patient
  std::vector<ReferencedPicture> pictures;  ///< whose pixels are meant, or what it was selected from
};

struct ReportMeasurement {
  Code name, unit;              ///< the unit's value is UCUM: "mm", "[hnsf'U]"
  std::optional<double> value;  ///< none where the report gives none
  std::vector<ReportProperty> properties;
  std::vector<ReportShape> shapes;  ///< what it was inferred from
};

/// A measurement group of TID 1500 (PS3.16 TID 1410, 1411, 1501).
struct MeasurementGroup {
  std::string trackingId, trackingUid;
  Code category, finding, site;             ///< empty where it is not said
  std::vector<ReportProperty> evaluations;  ///< all other codes: "Level of Significance"
  std::vector<ReportMeasurement> measurements;
  std::vector<ReportShape> shapes;
  std::vector<ReferencedPicture> pictures;  ///< sources and segmentations
};

/// A structured report: its title and, of TID 1500, its measurement groups. Text is UTF-8.
struct Report {
  Code title;
  std::vector<MeasurementGroup> groups;
  std::vector<std::string> warnings;  ///< what of it is left out and why: sentences without its name
};

/// A Key Object Selection document (PS3.16 TID 2010): pictures that are marked, and why.
struct KeyObjects {
  Code title;
  std::string text;                         ///< what is said of them
  std::vector<ReferencedPicture> pictures;  ///< those that are marked
};

/// Reads a report, and a key object document. An Error names the file and why.
Result<Report> loadReport(const std::string& path);
Result<KeyObjects> loadKeyObjects(const std::string& path);

/// The type's name for scripts: "polyline".
const char* typeName(ReportShape::Type type);

}  // namespace volumen
