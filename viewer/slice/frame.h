#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/slice/grey.h"

namespace volumen {

/// What the size of a pixel stands for (slices.md 4, PS3.3 10.7).
enum class PixelSizeKind {
  unknown,     ///< pixels only; `mm` is the shape of a pixel, no length
  patient,     ///< PixelSpacing of CT, MR, PET: mm in the patient
  calibrated,  ///< of a projection, calibrated by an object of known size
  unstated,    ///< of a projection, calibrated, the file does not say how
  atDetector,  ///< of a projection: mm at the detector
  magnified,   ///< at the detector, divided by the magnification
  filmScan     ///< NominalScannedPixelSpacing
};

struct PixelSize {
  glm::dvec2 mm{1};  ///< x: from column to column, y: from row to row
  PixelSizeKind kind = PixelSizeKind::unknown;
  bool operator==(const PixelSize&) const = default;
};

/// The word that stands beside lengths of it: "at detector"; empty: none, they are the patient's, or there
/// are none.
const char* pixelSizeWord(PixelSizeKind kind);

/// A layer over a frame: 60xx overlay planes. One byte a pixel of the frame, 1 where it draws.
struct FrameOverlay {
  std::string label;
  std::vector<std::uint8_t> mask;
};

/// A region of an ultrasound picture with units of its own (PS3.3 C.8.5.5); pixels, inclusive.
struct UltrasoundRegion {
  glm::ivec2 from{0}, to{0};
  int unitX = 0, unitY = 0;  ///< 3 = cm, 4 = s, 7 = cm/s
  glm::dvec2 delta{0};       ///< per pixel, in that unit; never below 0
  /// Along x and along y: the pixel of the frame that stands for 0 of its unit; none: the file does not say.
  std::optional<double> zero[2]{};
  glm::dvec2 sign{1};  ///< -1 where numbers fall from pixel to pixel
};

/// A named way from value to grey that the file offers.
struct NamedGrey {
  std::string name;  ///< WindowCenterWidthExplanation, LUTExplanation; empty where it has none
  GreyMapping mapping;
  bool ofValues = false;  ///< the file offers none: P0.1 .. P99.9 of the frame
};

/// Where a frame lies in the patient, mm.
struct FramePlace {
  glm::dvec3 origin{0};                      ///< the centre of its first pixel
  glm::dvec3 row{1, 0, 0}, column{0, 1, 0};  ///< unit vectors along a row and down a column
};

/// One picture as acquired, pixel for pixel (slices.md 2).
struct Frame {
  glm::ivec2 size{0};             ///< columns, rows
  std::vector<float> values;      ///< grey: after modality LUT or rescale, first row on top; else empty
  std::vector<std::uint8_t> rgb;  ///< colour: 3 a pixel; else empty
  std::vector<NamedGrey>
      greys;  ///< the file's windows and VOI LUTs, first is the default; never empty for grey
  std::optional<ValueRange> padding;  ///< values that stand for no value
  PixelSize pixel;
  std::optional<FramePlace> place;  ///< of slices whose file says it
  /// The patient's sides that rows and columns run to, in letters of L R A P S I: "L", "PI"; empty where the
  /// file does not say (PatientOrientation, PS3.3 C.7.6.1.1.1).
  std::string rowSide, columnSide;
  std::vector<FrameOverlay> overlays;
  std::vector<std::uint8_t> shutter;  ///< one byte a pixel, 1 where it hides; empty: none
  float shutterGrey = 0;              ///< what it hides behind, 0 black .. 1 white
  std::vector<UltrasoundRegion> regions;
  std::string unit;                   ///< "HU", ...; empty: none
  std::vector<std::string> warnings;  ///< what of the file is not shown and why: sentences without its name

  bool colour() const { return !rgb.empty(); }
};

}  // namespace volumen
