#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/dicom/data_set.h"
#include "io/dicom/directory.h"
#include "io/dicom/fragments.h"
#include "io/dicom/pet_facts.h"
#include "io/dicom/scanned_file.h"
#include "io/study/cine.h"
#include "io/study/derived_object.h"
#include "io/study/identity.h"
#include "io/study/warning.h"
#include "viewer/volume/volume.h"

namespace volumen::dicom {

/// The Image Pixel Module (PS3.3 C.7.6.3): how samples are stored.
struct PixelFormat {
  enum class Kind { integer, float32, float64 } kind = Kind::integer;
  int columns = 0, rows = 0, frames = 1;
  int bitsAllocated = 0, bitsStored = 0, highBit = 0;
  bool isSigned = false;
  bool bigEndian = false;     ///< byte order of native samples
  bool bytesInWords = false;  ///< bits or bytes in big endian 16-bit words (OW)
  std::string photometric = "MONOCHROME2";
  int samples = 1;          ///< per pixel; 3 for colour without palette
  bool planar = false;      ///< native samples in colour planes
  bool subsampled = false;  ///< native YBR_FULL_422: Y Y Cb Cr for two pixels

  bool isGrey() const { return photometric.starts_with("MONOCHROME"); }
  std::uint64_t framePixels() const { return std::uint64_t(columns) * std::uint64_t(rows); }
  std::uint64_t frameSamples() const { return framePixels() * std::uint64_t(subsampled ? 2 : samples); }
  std::uint64_t frameBytes() const { return bytesOf(1); }
  /// Returns the bytes of all frames. 1-bit frames are packed without gaps (PS3.5 8.1.1), so this is no
  /// multiple of frameBytes().
  std::uint64_t allBytes() const { return bytesOf(frames); }
  bool isBits() const { return bitsAllocated == 1; }

 private:
  std::uint64_t bytesOf(int count) const {
    const std::uint64_t all = frameSamples() * std::uint64_t(count);
    return isBits() ? all / 8 + (all % 8 > 0) : all * std::uint64_t(bitsAllocated / 8);
  }
};

/// Unit vectors along the rows (i) and columns (j) of a picture, LPS.
struct Orientation {
  glm::dvec3 row{1, 0, 0}, column{0, 1, 0};
};

/// A picture of a file: its values and its position.
struct Slice {
  int frame = 0;                       ///< frame within its file, from 0
  std::optional<glm::dvec3> position;  ///< ImagePositionPatient: centre of its first voxel, mm
  std::optional<Orientation> orientation;
  /// Position and orientation are relative to an ultrasound transducer, not to the patient.
  bool ofTransducer = false;
  std::optional<glm::dvec2> spacing;  ///< mm along i (between columns) and j (between rows)
  double thickness = 0;               ///< SliceThickness, mm; 0 if not given
  double slope = 1, intercept = 0;
  bool isRescaled = false;                  ///< the file gives slope and intercept
  std::string unit;                         ///< unit of its values
  bool isMapped = false;                    ///< slope and intercept belong to a real world value mapping
  std::optional<ValueRange> padding;        ///< stored values that are padding
  std::vector<Window> windows;              ///< windows on its values, mapped or not
  long instance = 0;                        ///< InstanceNumber; orders slices without positions
  std::string echoTime, bValue, timePoint;  ///< same form as in Series
  std::uint32_t inStack = 0;                ///< InStackPositionNumber, from 1; 0 if not given
  /// Values that may separate pictures at one position, one for each of separators() (separators.h).
  std::vector<std::string> separators;
};

/// Returns whether the slice has a known position in the patient.
inline bool isPlaced(const Slice& s) { return s.position && s.orientation && s.spacing; }

/// A Siemens mosaic, whose tiles are the slices of a volume, row by row from the upper left.
struct Mosaic {
  int columns = 0, rows = 0;  ///< size of the whole picture
  int tilesAcross = 0;
};

/// A multi-frame picture in several files (PS3.3 C.7.6.16.2.2.4).
struct Concatenation {
  std::string uid;          ///< empty if the file is whole
  int part = 0, parts = 0;  ///< part number from 1, and number of parts; 0 if not given
  int firstFrame = 0;       ///< number of frames in the preceding parts
};

/// The header of a file and its pictures.
struct FileHeader : SeriesIdentity {
  std::string path, sopInstanceUid;
  std::string unit;                 ///< Series::unit
  std::string time, contrastAgent;  ///< same form as in Series
  TransferSyntax syntax{"", "", Coding::native, {}, false};
  PixelFormat format;
  std::optional<Mosaic> mosaic;  ///< the frames are tiles of it; `format` describes one tile
  Concatenation concatenation;
  /// The bytes of each frame (in the inflated data set if deflated), or of a whole mosaic.
  std::vector<FrameRanges> frames;
  std::uint64_t inflatedFrom = 0;  ///< offset of the deflated data set in the file; 0 if not deflated
  std::vector<Slice> slices;       ///< one for each frame, or only one if all frames are alike
  std::string notVolume;           ///< why its frames are only shown as acquired; empty for slices
  Cine cine;
  std::optional<PetFacts> pet;        ///< PET only
  std::vector<std::string> warnings;  ///< sentences without the file's name
};

/// Fills in the pixel format, the bytes of each frame and the slices of a scanned file. `header` must hold
/// its path and syntax. An Error says why the file cannot be shown.
Status readPicture(const RegularFile& file, const ScannedFile& scanned, const DataSet& data,
                   FileHeader& header);

/// Returns the id of a file within a study: its SOPInstanceUID, else its name.
std::string instanceId(const FileHeader& file);

/// The result of inspecting a file.
struct Inspection {
  enum class Kind { notDicom, noPicture, refused, picture } kind = Kind::notDicom;
  std::string text;                            ///< noPicture: what it is; refused: the reason, a sentence
  FileHeader header;                           ///< complete for pictures; identity if known for others
  std::optional<DerivedObject> derivedObject;  ///< set if a file without picture refers to pictures
  std::optional<std::vector<ListedFile>> listed = {};  ///< the files that a DICOMDIR names
  std::optional<glm::dvec3> position = {};  ///< ImagePositionPatient of files that are no picture, mm
  bool again = false;                       ///< set if refused; same as Refused::again
};

/// Reads a file up to its pixel data and classifies it. It trusts no byte of the file. Beside it,
/// listAttributes parses headers, and PixelSource reads pixel data.
Inspection inspect(const std::string& path);

/// An Inspection with all elements of the header.
struct InspectedFile {
  ScannedFile scanned;
  Inspection found;
};
InspectedFile inspectFile(const std::string& path);

}  // namespace volumen::dicom
