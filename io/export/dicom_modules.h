#pragma once

#include <string>

#include "io/export/dicom_elements.h"
#include "io/study/identity.h"

namespace volumen {

// These functions return the modules shared by all written objects (PS3.3 C.7) as elements. Required
// attributes with unknown values are present but empty.

/// Patient.
DicomElements patientModule(const SeriesIdentity& who);

/// General Study and Patient Study.
DicomElements studyModule(const SeriesIdentity& who, const std::string& studyUid);

/// General Equipment of objects that no other machine made.
DicomElements equipmentModule();

/// Contributing Equipment: names this program, which made the object from images of another machine.
/// Contributors in the source's elements `before` come first.
DicomElements contributingEquipment(std::span<const DicomElement> before);

/// Frame of Reference.
DicomElements frameOfReferenceModule(const std::string& uid);

/// An image that another one is derived from.
struct SourcePicture {
  std::string sopClassUid, sopInstanceUid;
  int frame = 0;  ///< frame number from 1; 0 for a single-frame image
};

/// Returns the elements that mark an image as derived: how, in words, and from which sources.
DicomElements derivation(const std::string& words, std::span<const SourcePicture> sources);

/// Returns an item that holds a code.
DicomElements codeItem(const std::string& value, const std::string& scheme, const std::string& meaning,
                       int depth);

}  // namespace volumen
