#include "io/export/colour_series.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "io/export/dicom_folder.h"
#include "io/export/dicom_slice.h"
#include "io/study/series.h"

namespace volumen {

namespace {

// Returns what all slices have besides the elements of a Secondary Capture.
DicomElements ofColourSeries(const StudyObject& object, const ColourSlices& slices) {
  const std::string space = commonFrameOfReference(object.source());
  DicomElements all = frameOfReferenceModule(space.empty() ? randomUid() : space);
  append(all, {{0x0020000e, randomUid()}, {0x00180050, decimal(slices.thicknessMm)}});
  return all;
}

Status writeColourSlice(const StudyObject& object, DicomElements own, const std::vector<std::uint8_t>& rgb,
                        const std::string& folder, int k) {
  DcmFileFormat file;
  own.push_back({0x00200013, std::to_string(k + 1)});
  object.put(UID_SecondaryCaptureImageStorage, "OT", own, *file.getDataset());
  const OFCondition done = file.getDataset()->putAndInsertUint8Array(
      DcmTag(DCM_PixelData, EVR_OB), rgb.data(), static_cast<unsigned long>(rgb.size()));
  if (done.bad()) return Error{std::string("Cannot write a slice: ") + done.text() + "."};
  return saveSlice(file, folder, k);
}

}  // namespace

Status writeColourSeries(const Series& series, const CaptureTags& tags, const ColourSlices& slices,
                         const ColourSlice& slice, const std::string& folder, const Progress& progress,
                         const CancelToken& cancel) {
  const VoxelGeometry& geometry = slices.geometry;
  if (!geometry.calibrated)
    return Error{series.id +
                 " is not calibrated: slices along a plane need positions in mm; `volumen slice` "
                 "writes pictures."};
  const auto object = StudyObject::of(series, tags, progress, cancel);
  if (!object) return object.error();
  const DicomElements ofAll = ofColourSeries(*object, slices);
  const auto write = [&](const std::string& aside) -> Status {
    for (int k = 0; k < geometry.size.z; ++k) {
      if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
      if (progress) progress("writing slices", std::size_t(k), std::size_t(geometry.size.z));
      const auto rgb = slice(k);
      if (!rgb) return rgb.error();
      std::vector<SourcePicture> pictures = picturesOf(object->source(), slices.sources[std::size_t(k)]);
      const std::vector<SourcePicture>& others = slices.overlaid[std::size_t(k)];
      pictures.insert(pictures.end(), others.begin(), others.end());
      DicomElements own = captureElements(*object, series, tags, pictures, glm::ivec2(geometry.size), 1);
      append(own, ofAll);
      append(own, placeElements(geometry, k));
      if (Status s = writeColourSlice(*object, std::move(own), *rgb, aside, k); !s) return s;
    }
    return {};
  };
  return writeDicomFolder(folder, write);
}

}  // namespace volumen
