#include "io/export/dicom_series.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "io/export/dicom_elements.h"
#include "io/export/dicom_folder.h"
#include "io/export/dicom_slice.h"
#include "io/study/series.h"

namespace volumen {

namespace {

Status checkRepresentable(const Volume& volume) {
  const std::string& name = volume.attributes().name;
  const VoxelGeometry& g = volume.geometry();
  if (!g.calibrated)
    return Error{name + " is not calibrated: a DICOM series needs positions in mm; write .nrrd instead."};
  if (g.size.x > 65535 || g.size.y > 65535)
    return Error{name + ": DICOM slices have at most 65535 rows and columns."};
  const glm::dvec3 i = glm::normalize(g.patientFromVoxelStep[0]),
                   j = glm::normalize(g.patientFromVoxelStep[1]);
  if (std::abs(glm::dot(i, j)) > 1e-4)
    return Error{name +
                 ": the rows and columns of its slices are not perpendicular, which DICOM cannot say; "
                 "write .nrrd instead."};
  if (volume.attributes().modality == "RTDOSE")
    return Error{name + " holds doses, which are no series of slices in DICOM; write .nrrd or .nii.gz."};
  return {};
}

// DCMTK copies the words; it fails only if memory runs out.
OFCondition putPixels(const StoredSlice& pixels, glm::ivec3 size, DcmDataset& data) {
  const std::pair<DcmTagKey, int> numbers[] = {{DCM_SamplesPerPixel, 1},
                                               {DCM_Rows, size.y},
                                               {DCM_Columns, size.x},
                                               {DCM_BitsAllocated, 16},
                                               {DCM_BitsStored, 16},
                                               {DCM_HighBit, 15},
                                               {DCM_PixelRepresentation, pixels.isSigned ? 1 : 0}};
  OFCondition done = EC_Normal;
  for (const auto& [tag, number] : numbers)
    if (done.good()) done = data.putAndInsertUint16(DcmTag(tag, EVR_US), Uint16(number));
  if (done.good())
    done = data.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), pixels.words.data(),
                                        static_cast<unsigned long>(pixels.words.size()));
  return done;
}

Status writeSlice(const DicomSliceWriter& writer, int k, const StoredSlice& pixels, glm::ivec3 size,
                  const std::string& folder) {
  DcmFileFormat file;
  writer.put(k, pixels, *file.getDataset());
  const OFCondition done = putPixels(pixels, size, *file.getDataset());
  if (done.bad()) return Error{std::string("Cannot write a slice: ") + done.text() + "."};
  return saveSlice(file, folder, k);
}

// Returns the largest rounding error of all values.
Result<double> writeSlices(const Volume& volume, const DicomSliceWriter& writer, const std::string& folder,
                           const Progress& progress, const CancelToken& cancel) {
  double largestError = 0;
  for (int k = 0; k < volume.size().z; ++k) {
    if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
    if (progress) progress("writing slices", std::size_t(k), std::size_t(volume.size().z));
    const auto pixels = writer.pixels(k);
    if (!pixels)
      return Error{volume.attributes().name +
                   " holds real values that are not whole numbers within 16 bits, which DICOM pixels "
                   "cannot keep exactly; write .nrrd instead."};
    largestError = std::max(largestError, pixels->largestError);
    if (Status s = writeSlice(writer, k, *pixels, volume.size(), folder); !s) return s.error();
  }
  return largestError;
}

std::vector<std::string> notesOf(double largestError, const DicomSliceWriter& writer) {
  std::vector<std::string> notes;
  char text[128];
  std::snprintf(text, sizeof text, "Values were rounded to 16 bits a slice: at most %.3g off.", largestError);
  if (largestError > 0) notes.emplace_back(text);
  if (const std::string modality = writer.withoutClass(); !modality.empty())
    notes.push_back("Written as Secondary Capture of modality " + modality +
                    ": DICOM has no other class for its slices.");
  return notes;
}

}  // namespace

DicomSeriesTags dicomTags(const Series& series) {
  DicomSeriesTags tags;
  static_cast<SeriesIdentity&>(tags) = series;
  tags.bValue = series.bValue;
  tags.hasNoUnit = series.format == "DICOM" && series.modality == "CT" && series.unit.empty();
  if (series.format != "phantom") return tags;
  tags.synthetic = true;
  tags.patientName = "Volumen^Sample";
  tags.patientId = "VOLUMEN-SAMPLE";
  tags.studyDescription = "Synthetic phantom";
  tags.description = series.description + " (synthetic)";
  if (series.modality == "CT") {
    tags.studyDescription = "Synthetic head CT with contrast";
    tags.bodyPart = "HEAD";
    tags.patientPosition = "HFS";
    tags.kvp = "120";
    tags.windowNames = {"SOFT TISSUE", "BRAIN", "BONE"};
  }
  return tags;
}

Result<DicomSeriesTags> readDicomTags(const Series& series, const Loaded& loaded, const Progress& progress,
                                      const CancelToken& cancel) {
  DicomSeriesTags tags = dicomTags(series);
  if (series.format != "DICOM") return tags;
  Result<DicomSource> source = readDicomSource(series, progress, cancel);
  if (!source) return source.error();
  tags.source = std::move(*source);
  tags.origins = loaded.origins;
  return tags;
}

DicomSeriesTags tagsWithout(const TakenAway& what, DicomSeriesTags all, int seriesNumber) {
  const std::string& of = all.description;
  all.description = inOneLine(what.title + (of.empty() ? of : ": " + of));
  all.seriesNumber = std::to_string(seriesNumber);
  all.takenAway = what.parts;
  return all;
}

DicomSeriesTags defacedTags(DicomSeriesTags ofSource, int seriesNumber) {
  const TakenAway face{"Without face", "the face and the air in front of it"};
  DicomSeriesTags tags = tagsWithout(face, std::move(ofSource), seriesNumber);
  tags.isDefaced = true;
  return tags;
}

Result<std::vector<std::string>> writeDicomSeries(const Volume& volume, const DicomSeriesTags& tags,
                                                  const std::string& folder, const Progress& progress,
                                                  const CancelToken& cancel) {
  if (Status s = checkRepresentable(volume); !s) return s.error();
  const DicomSliceWriter writer(volume, tags);
  double largestError = 0;
  const auto write = [&](const std::string& aside) -> Status {
    const Result<double> written = writeSlices(volume, writer, aside, progress, cancel);
    if (!written) return written.error();
    largestError = *written;
    return {};
  };
  if (Status s = writeDicomFolder(folder, write); !s) return s.error();
  return notesOf(largestError, writer);
}

}  // namespace volumen
