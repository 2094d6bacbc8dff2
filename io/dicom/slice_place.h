#pragma once

#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// Adds a sentence to a file's warnings, once.
void warnOnce(FileHeader& header, const std::string& sentence);

/// Takes over where `scope` says that a slice lies in the patient: position, directions, whichever are there.
void readPlace(const DataSet& data, DataSet::Scope scope, Slice& slice, FileHeader& header);

/// The same of one frame, from its functional groups where it has such. Frames of ultrasound volumes lie in
/// the space of their transducer (PS3.3 C.8.24.6.1), where they do not say their place in the patient.
void readPlace(const DataSet& data, const FrameScopes& at, Slice& slice, FileHeader& header);

/// Functional groups that hold a frame's place.
inline constexpr std::uint32_t planePosition = 0x00209113, planePositionInVolume = 0x0020930e;

}  // namespace volumen::dicom
