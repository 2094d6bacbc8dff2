#pragma once

#include <string>
#include <vector>

#include "io/dicom/header.h"

namespace volumen::dicom {

/// Files whose pictures may belong to one volume, and what is to be told of who they say they are.
struct SameIdentity {
  std::vector<const FileHeader*> files;
  std::vector<Warning> warnings;
};

/// Files by whose they are: series, study, patient (PatientID with its issuer, PS3.3 C.7.1.1; the name where
/// there is no ID) and frame of reference (PS3.3 C.7.4.1.1.1: positions of two cannot be compared). Names
/// spelt in several ways, and UIDs that contradict patients, are told. Where each of four files or more
/// names a frame of reference of its own, the UIDs were made anew file by file: they are one, and that is
/// told. Files that name no frame of reference are in the only one that is named, and that is told, unless
/// both are whole stacks that lie in each other. A file without SeriesInstanceUID is by itself.
std::vector<SameIdentity> byIdentity(const std::vector<FileHeader>& files);

}  // namespace volumen::dicom
