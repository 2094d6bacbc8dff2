#pragma once

#include <map>

#include "io/export/dicom_elements.h"
#include "io/export/dicom_source.h"
#include "io/presentation.h"
#include "viewer/slice/frame.h"

namespace volumen {

/// The attributes of a presentation state beside patient, study and series (PS3.3 A.33.1).
class PresentationElements {
 public:
  /// `files` are those of the pictures by their UIDs. The arguments must outlive the object.
  PresentationElements(const Presentation& presentation, const Frame& frame,
                       const std::map<std::string, const DicomSourceFile*>& files)
      : p_(presentation), frame_(frame), files_(files) {}

  /// Returns all elements, which refer to `pictures`.
  DicomElements all(const std::vector<ReferencedPicture>& pictures, const std::string& seriesUid);
  /// Returns notes for the user about what was left out by all().
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  DicomElements pictureItems(const std::vector<ReferencedPicture>& pictures, int depth) const;
  DicomElements values() const;
  DicomElements greys(const Presentation::Greys& part);
  DicomElements shutter();
  DicomElements area(const Presentation::Area& part) const;
  DicomElements layers();
  DicomElements annotations(const Presentation::Annotations& part);
  DicomElements graphic(const Graphic& graphic);
  std::string layerName(const std::string& name);

  const Presentation& p_;
  const Frame& frame_;
  const std::map<std::string, const DicomSourceFile*>& files_;
  std::map<std::string, std::string> layerNames_;  // as written, by those of the presentation
  std::vector<std::string> notes_;
};

}  // namespace volumen
