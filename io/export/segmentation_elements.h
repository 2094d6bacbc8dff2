#pragma once

#include "io/export/dicom_elements.h"
#include "io/export/dicom_uid.h"
#include "io/export/segmentation_dicom.h"
#include "io/export/segmentation_frames.h"
#include "io/study/identity.h"
#include "viewer/segment/segment.h"

namespace volumen {

/// The attributes of a segmentation object beside its pixels (PS3.3 A.51).
class SegmentationElements {
 public:
  /// `sliceDistance` is in mm. The arguments must outlive the object.
  SegmentationElements(const SeriesIdentity& series, const DicomSource& source,
                       const SegmentationFrames& frames, std::span<const Segment> segments,
                       const SegmentationTags& tags, double sliceDistance);

  /// Returns all elements, in groups to be written one after the other.
  std::vector<DicomElements> all() const;
  /// Returns notes for the user.
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
  std::vector<int> used_;  // slices of the source that have frames, in ascending order
};

}  // namespace volumen
