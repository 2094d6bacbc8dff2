#pragma once

#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// Adds a sentence to a file's warnings unless it is already there.
void warnOnce(FileHeader& header, const std::string& sentence);

/// Sets position and orientation of a slice in the patient as far as `scope` gives them.
void readPlace(const DataSet& data, DataSet::Scope scope, Slice& slice, FileHeader& header);

/// Sets position and orientation of a frame from its functional groups or the data set. Frames of ultrasound
/// volumes are in the space of their transducer (PS3.3 C.8.24.6.1) unless they have a position in the
/// patient.
void readPlace(const DataSet& data, const FrameScopes& at, Slice& slice, FileHeader& header);

/// Functional groups that hold a frame's position.
inline constexpr std::uint32_t planePosition = 0x00209113, planePositionInVolume = 0x0020930e;

}  // namespace volumen::dicom
