#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "io/export/dicom_elements.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct Series;

/// What a frame of a DICOM file says that holds for a copy of it.
struct DicomSourceFrame {
  /// Where it lies in the patient: the centre of its first pixel, unit vectors along a row and down a
  /// column, mm from column to column and from row to row.
  struct Place {
    glm::dvec3 position{0}, right{1, 0, 0}, down{0, 1, 0};
    glm::dvec2 mm{1};
  };
  std::optional<Place> place;
  double slope = 1, intercept = 0;
  DicomElements elements;  ///< of its functional groups, as pictures of one frame have them
};

/// What a DICOM file says that holds for a copy of it: patient, study, series, frame of reference, equipment,
/// acquisition, windows. What describes its samples, their places and the file itself is left out.
struct DicomSourceFile {
  std::string problem;  ///< a sentence without the file's name, where it cannot be read
  std::string sopClassUid, sopInstanceUid;
  bool isSigned = false, isMultiFrame = false;
  DicomElements elements;
  std::vector<DicomSourceFrame> frames;
};

/// What the slices of a series say of themselves.
struct DicomSource {
  struct Slice {
    std::size_t file = 0, frame = 0;
  };
  std::vector<DicomSourceFile> files;
  std::vector<Slice> slices;  ///< one each of Series::files

  const DicomSourceFile& file(int slice) const { return files[slices[std::size_t(slice)].file]; }
  const DicomSourceFrame& frame(int slice) const {
    return file(slice).frames[slices[std::size_t(slice)].frame];
  }
};

/// Reads the headers of a DICOM series again, in workers where there are any. An Error names a file that is
/// not what it was.
Result<DicomSource> readDicomSource(const Series& series, const Progress& progress,
                                    const CancelToken& cancel);

}  // namespace volumen
