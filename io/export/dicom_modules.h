#pragma once

#include <string>

#include "io/export/dicom_elements.h"
#include "io/study/identity.h"

namespace volumen {

// The modules that every object written shares (PS3.3 C.7), each as elements. Attributes that an object must
// have are there where nothing is known, too: empty.

/// Patient: whose it is.
DicomElements patientModule(const SeriesIdentity& who);

/// General Study and Patient Study.
DicomElements studyModule(const SeriesIdentity& who, const std::string& studyUid);

/// General Equipment of what no other machine made.
DicomElements equipmentModule();

/// Contributing Equipment: that this program made it from pictures of another machine; `before`: the elements
/// that a source holds, whose contributors come first.
DicomElements contributingEquipment(std::span<const DicomElement> before);

/// Frame of Reference.
DicomElements frameOfReferenceModule(const std::string& uid);

/// A picture that another is derived from.
struct SourcePicture {
  std::string sopClassUid, sopInstanceUid;
  int frame = 0;  ///< from 1; 0: the picture has one
};

/// That a picture is derived: how, in words, and from which.
DicomElements derivation(const std::string& words, std::span<const SourcePicture> sources);

/// An item that holds a code.
DicomElements codeItem(const std::string& value, const std::string& scheme, const std::string& meaning,
                       int depth);

}  // namespace volumen
