#pragma once

#include <optional>

#include "io/export/dicom_pixels.h"
#include "io/export/dicom_series.h"
#include "io/export/dicom_uid.h"

namespace volumen {

/// Writes the elements of the slices of one series.
class DicomSliceWriter {
 public:
  DicomSliceWriter(const Volume& volume, const DicomSeriesTags& tags);

  /// Puts all elements of slice `k` except its pixels into a data set.
  void put(int k, const StoredSlice& pixels, DcmItem& into) const;

  /// Returns how slice `k` is stored in its source; empty if it is interpolated or has no source.
  std::optional<StoredAs> storedAs(int k) const;

  /// True if values may be rounded: only for PET, where each slice has a rescale of its own.
  bool mayRound() const { return isPet_; }
  /// Returns the modality if it has no storage class for single slices, so that Secondary Capture is written;
  /// else an empty string.
  std::string withoutClass() const;

 private:
  DicomElements identityElements() const;
  DicomElements seriesElements() const;
  DicomElements sourceElements(int k) const;
  DicomElements derivedElements(int k, const StoredSlice& pixels, std::span<const DicomElement> source) const;
  DicomElements placeElements(int k) const;
  std::string imageType(const std::string& ofSource) const;
  const SliceOrigin* originOf(int k) const;
  DicomElements derivationOf(int k, const StoredSlice& pixels) const;

  const Volume& volume_;
  const DicomSeriesTags& tags_;
  DicomUids uids_;
  DicomElements first_;  // elements of the first slice of the source
  bool isPet_ = false;
  DicomElements identity_, series_;
};

}  // namespace volumen
