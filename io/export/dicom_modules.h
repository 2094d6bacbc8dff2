#pragma once

#include <string>

#include "io/export/dicom_elements.h"
#include "io/study/identity.h"
#include "viewer/segment/code.h"

namespace volumen {

// These functions return the modules shared by all written objects (PS3.3 C.7) as elements. Required
// attributes with unknown values are present but empty.

/// Patient.
DicomElements patientModule(const SeriesIdentity& who);

/// General Study and Patient Study.
DicomElements studyModule(const SeriesIdentity& who, const std::string& studyUid);

/// Returns whether an attribute is one of patient and study, which hold for every object made of an image.
bool isOfStudy(std::uint32_t tag);
/// Returns the elements of patient and study of a file.
DicomElements studyElements(const DicomElements& ofFile);

/// General Equipment of objects that no other machine made.
DicomElements equipmentModule();
/// The same with the attributes of Enhanced General Equipment.
DicomElements enhancedEquipmentModule();

/// True for paired body parts and unknown ones: images of them need Laterality, even if empty.
bool mayBePaired(const std::string& bodyPart);
/// Body part and laterality of an image or presentation state (General Series).
DicomElements bodyPart(const SeriesIdentity& who);

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

/// True if a code has a value and a scheme.
bool isWhole(const Code& code);
/// Returns a sequence of one code. Values of more than 16 characters become long code values, and URNs stay
/// URNs (PS3.3 8.8); a code without meaning has its value as meaning.
DicomElements codeSequence(std::uint32_t tag, const Code& code, int depth);

}  // namespace volumen
