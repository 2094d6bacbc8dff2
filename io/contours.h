#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/study/derived_object.h"
#include "viewer/segment/code.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A contour of a region of interest, in patient mm (LPS).
struct Contour {
  enum class Type {
    point,          ///< one position
    openPlanar,     ///< a line in a plane
    openNonplanar,  ///< a line
    closedPlanar,   ///< an outline in a plane; the last point is joined to the first
    /// a closed contour; among several in one plane, points inside an odd number of them are inside
    closedPlanarXor
  } type = Type::closedPlanar;
  std::vector<glm::dvec3> points;
  std::vector<ReferencedPicture> pictures;  ///< the images on which it was drawn
};

/// A region of interest.
struct RegionOfInterest {
  int number = 0;
  std::string name, description, algorithm;  ///< UTF-8
  std::string type;                          ///< RT ROI Interpreted Type: "GTV", "ORGAN"; may be empty
  Code code;                                 ///< what it is, as a code; may be empty
  std::optional<glm::u8vec3> colour;         ///< sRGB
  std::string frameOfReferenceUid;
  std::vector<Contour> contours;  ///< contours in the file's order
};

/// An RT Structure Set (PS3.3 A.19). Contours are placed by their patient coordinates, whatever images they
/// reference.
struct StructureSet {
  std::string label, name, description;
  std::vector<RegionOfInterest> regions;
  std::vector<std::string> warnings;  ///< parts left out and why: sentences without its name
};

/// Reads a structure set. The Error names the file and the reason.
Result<StructureSet> loadContours(const std::string& path);

/// Returns the area of a closed contour in mm^2; 0 for others.
double areaOf(const Contour& contour);

/// Returns the type's name for scripts: "closedPlanar".
const char* typeName(Contour::Type type);

}  // namespace volumen
