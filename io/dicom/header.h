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

/// The Image Pixel Module (PS3.3 C.7.6.3): how samples are written.
struct PixelFormat {
  enum class Kind { integer, float32, float64 } kind = Kind::integer;
  int columns = 0, rows = 0, frames = 1;
  int bitsAllocated = 0, bitsStored = 0, highBit = 0;
  bool isSigned = false;
  bool bigEndian = false;     ///< of native samples
  bool bytesInWords = false;  ///< bits or bytes in big endian 16-bit words (OW)
  std::string photometric = "MONOCHROME2";
  int samples = 1;          ///< a pixel: 3 for colour that is no palette
  bool planar = false;      ///< native samples: all of one colour after all of another
  bool subsampled = false;  ///< native YBR_FULL_422: Y Y Cb Cr for two pixels

  bool isGrey() const { return photometric.starts_with("MONOCHROME"); }
  std::uint64_t framePixels() const { return std::uint64_t(columns) * std::uint64_t(rows); }
  std::uint64_t frameSamples() const { return framePixels() * std::uint64_t(subsampled ? 2 : samples); }
  std::uint64_t frameBytes() const { return bytesOf(1); }
  /// Bits run on from one frame to the next (PS3.5 8.1.1): what all take, not a number of frameBytes().
  std::uint64_t allBytes() const { return bytesOf(frames); }
  bool isBits() const { return bitsAllocated == 1; }

 private:
  std::uint64_t bytesOf(int count) const {
    const std::uint64_t all = frameSamples() * std::uint64_t(count);
    return isBits() ? all / 8 + (all % 8 > 0) : all * std::uint64_t(bitsAllocated / 8);
  }
};

/// Unit vectors along a picture's rows (i) and down its columns (j), LPS.
struct Orientation {
  glm::dvec3 row{1, 0, 0}, column{0, 1, 0};
};

/// One picture of a file: what it shows and where it lies.
struct Slice {
  int frame = 0;                       ///< in its file, from 0
  std::optional<glm::dvec3> position;  ///< ImagePositionPatient, mm: the centre of its first voxel
  std::optional<Orientation> orientation;
  bool ofTransducer = false;          ///< they are those of an ultrasound transducer, not of the patient
  std::optional<glm::dvec2> spacing;  ///< mm along i (between columns) and j (between rows)
  double thickness = 0;               ///< SliceThickness, mm; 0: not given
  double slope = 1, intercept = 0;
  bool isRescaled = false;                  ///< the file gives slope and intercept
  std::string unit;                         ///< of its values
  bool isMapped = false;                    ///< slope and intercept are those of a real world value mapping
  std::optional<ValueRange> padding;        ///< stored values that stand for no picture
  std::vector<Window> windows;              ///< of its values, also where those are mapped
  long instance = 0;                        ///< InstanceNumber; order of slices that nothing else orders
  std::string echoTime, bValue, timePoint;  ///< as Series has them
  std::uint32_t inStack = 0;                ///< InStackPositionNumber, from 1; 0: not given
  std::vector<std::string> separators;      ///< what may tell apart pictures of one place: a value for each
                                            ///< of separators() (io/dicom/separators.h)
};

/// Whether it is known where in the patient a slice lies.
inline bool isPlaced(const Slice& s) { return s.position && s.orientation && s.spacing; }

/// A Siemens mosaic: the slices of a volume are tiles of one picture, row by row from the upper left.
struct Mosaic {
  int columns = 0, rows = 0;  ///< of the whole picture
  int tilesAcross = 0;
};

/// A multi-frame picture that is spread over several files (PS3.3 C.7.6.16.2.2.4).
struct Concatenation {
  std::string uid;          ///< empty: the file is whole
  int part = 0, parts = 0;  ///< from 1; 0: not given
  int firstFrame = 0;       ///< frames in the parts before
};

/// What a file says about itself and its pictures.
struct FileHeader : SeriesIdentity {
  std::string path, sopInstanceUid;
  std::string unit;                 ///< Series::unit
  std::string time, contrastAgent;  ///< as Series has them
  TransferSyntax syntax{"", "", Coding::native, {}, false};
  PixelFormat format;
  std::optional<Mosaic> mosaic;  ///< the frames are its tiles; `format` is that of a tile
  Concatenation concatenation;
  std::vector<FrameRanges> frames;  ///< where each frame's bytes lie (in the inflated data set if deflated);
                                    ///< of a mosaic, of the whole picture
  std::uint64_t inflatedFrom = 0;   ///< where the deflated data set begins in the file; 0: it is not deflated
  std::vector<Slice> slices;        ///< one a frame; only one where all frames are alike
  std::string notVolume;            ///< why its frames can only be shown as acquired; empty: they are slices
  Cine cine;
  std::optional<PetFacts> pet;        ///< of PET
  std::vector<std::string> warnings;  ///< sentences without the file's name
};

/// Fills in how the pixels of a scanned file are written, where each frame's bytes lie and what it shows.
/// `header` holds its path and syntax. An Error says why it cannot be shown.
Status readPicture(const RegularFile& file, const ScannedFile& scanned, const DataSet& data,
                   FileHeader& header);

/// What tells one file of a study from another: its SOPInstanceUID, else its name.
std::string instanceId(const FileHeader& file);

/// What a file turned out to be.
struct Inspection {
  enum class Kind { notDicom, noPicture, refused, picture } kind = Kind::notDicom;
  std::string text;                                    ///< noPicture: what it is; refused: why, a sentence
  FileHeader header;                                   ///< picture; of others its identity, where known
  std::optional<DerivedObject> derivedObject;          ///< noPicture that refers to pictures
  std::optional<std::vector<ListedFile>> listed = {};  ///< the files that a DICOMDIR names
  std::optional<glm::dvec3> position = {};             ///< not picture: ImagePositionPatient, mm
  bool again = false;                                  ///< refused, as Refused has it
};

/// Reads a file up to its pixel data and says what it is. Never trusts it: this is the first of the two
/// functions that touch the bytes of a DICOM file (the other is PixelSource).
Inspection inspect(const std::string& path);

/// What a file turned out to be, and all elements of its header for whoever wants more of them.
struct InspectedFile {
  ScannedFile scanned;
  Inspection found;
};
InspectedFile inspectFile(const std::string& path);

}  // namespace volumen::dicom
