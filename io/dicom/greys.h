#pragma once

#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"
#include "io/presentation.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// Returns the windows of `scope` in file order, with their explanations and function (PS3.3 C.11.2.1.2).
/// Windows without a width are left out.
std::vector<NamedGrey> readWindows(const DataSet& data, DataSet::Scope scope);

/// Returns the windows of `scope`, then its VOI LUTs. LUT inputs may be negative if `signedInput`. `warnings`
/// names LUTs that are left out.
std::vector<NamedGrey> readMappings(const DataSet& data, DataSet::Scope scope, bool signedInput,
                                    std::vector<std::string>& warnings);

/// Returns whether Presentation LUT Shape inverts greys.
bool isInverse(const DataSet& data);

/// Copies the Modality LUT Sequence of a data set to `mapping`, if present. An Error says what is wrong in
/// it.
Status readModalityLut(const DataSet& data, bool isSigned, ValueMapping& mapping);

/// Converts a grey mapping from values after the modality LUT to the slice's values. These differ under a
/// real world value mapping, and windows are mapped with them (LINEAR as its exact equivalent).
NamedGrey greyOfSlice(NamedGrey grey, const Slice& slice);

/// The sentence about mapped values, after "its".
extern const std::string realWorldSentence;

/// Returns all grey mappings that the file offers for a frame: windows, then VOI LUTs. Without either,
/// returns the range of the values themselves (P0.1 .. P99.9). `warnings` names LUTs that are left out.
std::vector<NamedGrey> readGreys(const DataSet& data, const FrameScopes& at, const FileHeader& header,
                                 const Slice& slice, const Frame& frame, std::vector<std::string>& warnings);

}  // namespace volumen::dicom
