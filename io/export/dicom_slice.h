#pragma once

#include <optional>

#include "io/export/dicom_pixels.h"
#include "io/export/dicom_series.h"
#include "io/export/dicom_uid.h"

namespace volumen {

/// Returns the frame of reference of all slices of a source, or an empty string if they differ.
std::string commonFrameOfReference(const DicomSource& source);
/// Returns the elements that say where slice `k` of a grid lies (Image Plane).
DicomElements placeElements(const VoxelGeometry& geometry, int k);

/// Writes the elements of the slices of one series.
class DicomSliceWriter {
 public:
  DicomSliceWriter(const Volume& volume, const DicomSeriesTags& tags);

  /// Puts all elements of slice `k` except its pixels into a data set.
  void put(int k, const StoredSlice& pixels, DcmItem& into) const;

  /// Returns the pixels of slice `k`; empty if 16 bits cannot hold them and they may not be rounded.
  std::optional<StoredSlice> pixels(int k) const;

  /// Returns the modality if it has no storage class for single slices, so that Secondary Capture is written;
  /// else an empty string.
  std::string withoutClass() const;

 private:
  DicomElements identityElements() const;
  DicomElements seriesElements() const;
  DicomElements sourceElements(int k) const;
  DicomElements derivedElements(int k, const StoredSlice& pixels, std::span<const DicomElement> source) const;
  std::string imageType(const std::string& ofSource) const;
  std::vector<int> sourcesOf(int k) const;
  std::optional<StoredAs> storedAs(int k) const;
  DicomElements commonOfAll() const;
  DicomElements withoutIdentity(DicomElements all) const;
  DicomElements placeOf(int k) const;
  DicomElements derivationOf(int k, const StoredSlice& pixels) const;

  const Volume& volume_;
  const DicomSeriesTags& tags_;
  DicomUids uids_;
  DicomElements first_;  // elements of the first slice of the source
  bool isPet_ = false;
  DicomElements identity_, series_;
  DicomElements ofAll_;                  // elements of all slices of the source, if slices are resampled
  std::optional<StoredAs> storedAsOne_;  // of slices that are resampled, except for PET
};

}  // namespace volumen
