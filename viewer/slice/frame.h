#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/slice/pixel_values.h"

namespace volumen {

/// Meaning of the pixel size (slices.md 4, PS3.3 10.7).
enum class PixelSizeKind {
  unknown,     ///< Pixels only; `mm` gives the aspect ratio, not lengths
  patient,     ///< PixelSpacing of CT, MR, PET: mm in the patient
  calibrated,  ///< Projection, calibrated with an object of known size
  unstated,    ///< Projection, calibrated in an unstated way
  atDetector,  ///< Projection: mm at the detector
  magnified,   ///< Detector size divided by the magnification
  filmScan     ///< NominalScannedPixelSpacing
};

struct PixelSize {
  glm::dvec2 mm{1};  ///< x: column spacing, y: row spacing
  PixelSizeKind kind = PixelSizeKind::unknown;
  bool operator==(const PixelSize&) const = default;
};

/// Returns the label for lengths of this kind, such as "at detector". Empty if they are true patient lengths
/// or there are none.
const char* pixelSizeWord(PixelSizeKind kind);

/// A 60xx overlay plane: one byte per pixel of the frame, 1 where it draws.
struct FrameOverlay {
  std::string label;
  std::vector<std::uint8_t> mask;
};

/// A region of an ultrasound picture with its own units (PS3.3 C.8.5.5), in pixels, inclusive.
struct UltrasoundRegion {
  glm::ivec2 from{0}, to{0};
  int unitX = 0, unitY = 0;  ///< 3 = cm, 4 = s, 7 = cm/s
  glm::dvec2 delta{0};       ///< Units per pixel; never negative
  /// Pixel of the frame at 0 of the unit, along x and along y; empty if the file does not say.
  std::optional<double> zero[2]{};
  glm::dvec2 sign{1};  ///< -1 if values decrease from pixel to pixel
};

/// A named grey mapping that the file offers.
struct NamedGrey {
  std::string name;  ///< WindowCenterWidthExplanation or LUTExplanation; may be empty
  GreyMapping mapping;
  bool ofValues = false;  ///< True if the file has none: P0.1 .. P99.9 of the frame
};

/// Position of a frame in patient space, mm.
struct FramePlace {
  glm::dvec3 origin{0};                      ///< Centre of the first pixel
  glm::dvec3 row{1, 0, 0}, column{0, 1, 0};  ///< Unit vectors along a row and down a column
};

/// One acquired image, pixel for pixel (slices.md 2).
struct Frame {
  glm::ivec2 size{0};             ///< Columns, rows
  PixelValues values;             ///< Grey: values after modality LUT or rescale; else empty
  ValueMapping mapping;           ///< From stored values to `values`
  std::vector<std::uint8_t> rgb;  ///< Colour: 3 bytes per pixel; else empty
  std::vector<NamedGrey> greys;   ///< The file's windows and VOI LUTs, default first; never empty for grey
  std::optional<ValueRange> padding;  ///< Values that mean no value
  PixelSize pixel;
  std::optional<FramePlace> place;  ///< Set for slices whose file states it
  /// Patient directions of rows and columns as letters of L R A P S I, such as "L" or "PI". Empty if the file
  /// does not say (PatientOrientation, PS3.3 C.7.6.1.1.1).
  std::string rowSide, columnSide;
  std::vector<FrameOverlay> overlays;
  std::vector<std::uint8_t> shutter;  ///< One byte per pixel, 1 where it hides; empty if there is no shutter
  float shutterGrey = 0;              ///< Grey of hidden pixels, 0 black .. 1 white
  std::vector<UltrasoundRegion> regions;
  std::string unit;  ///< For example "HU"; may be empty
  /// Parts of the file that are not shown, and why; whole sentences without its name.
  std::vector<std::string> warnings;

  bool colour() const { return !rgb.empty(); }
};

}  // namespace volumen
