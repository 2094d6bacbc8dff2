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

  /// Puts all of slice `k` but its pixels into a data set.
  void put(int k, const StoredSlice& pixels, DcmItem& into) const;

  /// How slice `k` is stored in its source; nothing where it is interpolated or there is none.
  std::optional<StoredAs> storedAs(int k) const;

  /// Whether values may be rounded: of PET alone, each slice of which has a rescale of its own.
  bool mayRound() const { return isPet_; }
  /// The modality, where its pictures have no class of single slices and are written as Secondary Capture.
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
  DicomElements first_;  // what the first slice of the source says
  bool isPet_ = false;
  DicomElements identity_, series_;
};

}  // namespace volumen
