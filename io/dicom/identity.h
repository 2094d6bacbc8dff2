#pragma once

#include <string>
#include <vector>

#include "io/dicom/header.h"

namespace volumen::dicom {

/// Files whose pictures may form one volume, with warnings about their identity.
struct SameIdentity {
  std::vector<const FileHeader*> files;
  std::vector<Warning> warnings;
};

/// Groups files by series, study, patient and frame of reference. The patient is PatientID with its issuer
/// (PS3.3 C.7.1.1), else the name. Positions of two frames of reference cannot be compared (PS3.3
/// C.7.4.1.1.1). A file without SeriesInstanceUID is a group of its own. Warnings tell of
/// - several spellings of a name, and UIDs that contradict patients;
/// - four files or more that each name a frame of reference of their own: those are taken as one;
/// - files that name none: they join the only one named, unless both are whole stacks that interleave.
std::vector<SameIdentity> byIdentity(const std::vector<FileHeader>& files);

}  // namespace volumen::dicom
