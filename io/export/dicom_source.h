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

/// Attributes of a frame of a DICOM file that also hold for a copy of it.
struct DicomSourceFrame {
  /// Position in the patient: centre of the first pixel in mm, unit vectors along a row and down a column,
  /// spacing in mm between columns and between rows.
  struct Place {
    glm::dvec3 position{0}, right{1, 0, 0}, down{0, 1, 0};
    glm::dvec2 mm{1};
  };
  std::optional<Place> place;
  double slope = 1, intercept = 0;
  DicomElements elements;  ///< elements of its functional groups, in the form of single-frame images
};

/// Attributes of a DICOM file that also hold for a copy of it: patient, study, series, frame of reference,
/// equipment, acquisition, windows. Attributes of its samples, their geometry and the file itself are left
/// out.
struct DicomSourceFile {
  std::string problem;  ///< a sentence without the file's name if the file cannot be read; else empty
  std::string sopClassUid, sopInstanceUid;
  bool isSigned = false;
  int frameCount = 1;  ///< of the whole file; 1 for a mosaic
  DicomElements elements;
  DicomElements ofStudy;  ///< its elements of patient and study, with texts in `characterSet`
  std::string
      characterSet;  ///< that of the file, or ISO_IR 192 if the file's texts are not in the declared one
  std::vector<DicomSourceFrame> frames;  ///< one for each frame, or only one if all are alike

  bool isMultiFrame() const { return frameCount > 1; }
};

/// Attributes of the slices of a series.
struct DicomSource {
  struct Slice {
    std::size_t file = 0, frame = 0;
  };
  std::vector<DicomSourceFile> files;
  std::vector<Slice> slices;  ///< parallel to Series::files

  const DicomSourceFile& file(int slice) const { return files[slices[std::size_t(slice)].file]; }
  const DicomSourceFrame& frame(int slice) const {
    const std::vector<DicomSourceFrame>& frames = file(slice).frames;
    return frames[frames.size() == 1 ? 0 : slices[std::size_t(slice)].frame];
  }
};

/// Reads the headers of a DICOM series again, in workers if there are any. The Error names a file that has
/// changed since.
Result<DicomSource> readDicomSource(const Series& series, const Progress& progress,
                                    const CancelToken& cancel);

}  // namespace volumen
