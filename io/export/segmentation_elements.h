#pragma once

#include "io/export/dicom_elements.h"
#include "io/export/dicom_uid.h"
#include "io/export/segmentation_dicom.h"
#include "io/export/segmentation_frames.h"
#include "io/study/identity.h"
#include "viewer/segment/segment.h"

namespace volumen {

/// What a segmentation object says beside its pixels (PS3.3 A.51).
class SegmentationElements {
 public:
  /// `sliceDistance`: mm from one slice to the next. All must outlive it.
  SegmentationElements(const SeriesIdentity& series, const DicomSource& source,
                       const SegmentationFrames& frames, std::span<const Segment> segments,
                       const SegmentationTags& tags, double sliceDistance);

  /// All of them, in groups that can be put one after the other.
  std::vector<DicomElements> all() const;
  /// Sentences that are to be known.
  std::vector<std::string> notes() const;

 private:
  DicomElements identity() const;
  DicomElements sourceReferences() const;
  DicomElements image() const;
  DicomElements segmentItem(std::size_t n) const;
  DicomElements trackingOf(const Segment& segment, const std::string& name) const;
  DicomElements dimensions() const;
  DicomElements sharedGroups() const;
  DicomElements frameGroups(const SegmentationFrames::Frame& frame) const;
  const DicomSourceFrame::Place& place(int slice) const { return *source_.frame(slice).place; }

  const SeriesIdentity& series_;
  const DicomSource& source_;
  const SegmentationFrames& frames_;
  std::span<const Segment> segments_;
  const SegmentationTags& tags_;
  double sliceDistance_;
  DicomUids uids_;
  std::vector<int> used_;  // slices that frames lie on, in order
};

}  // namespace volumen
