#pragma once

#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"
#include "io/presentation.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// The windows that stand in `scope`, in the file's order, with their explanations and their function
/// (PS3.3 C.11.2.1.2). Windows without a width are left out.
std::vector<NamedGrey> readWindows(const DataSet& data, DataSet::Scope scope);

/// The windows of `scope`, then its VOI LUTs, whose inputs may be negative where `signedInput`. `warnings`:
/// LUTs that are left out.
std::vector<NamedGrey> readMappings(const DataSet& data, DataSet::Scope scope, bool signedInput,
                                    std::vector<std::string>& warnings);

/// Whether its Presentation LUT Shape turns greys over.
bool isInverse(const DataSet& data);

/// Takes over the Modality LUT Sequence of a data set, where there is one. An Error says what is wrong in it.
Status readModalityLut(const DataSet& data, bool isSigned, ValueMapping& mapping);

/// A grey of the values after the modality LUT as one of the slice's values: those of a real world value
/// mapping are others, and windows go with them (LINEAR as what it is exactly).
NamedGrey greyOfSlice(NamedGrey grey, const Slice& slice);

/// What is said of mapped values, behind "its".
extern const std::string realWorldSentence;

/// All ways from value to grey that the file offers for a frame of these values: windows, then VOI LUTs;
/// where there are none, the values' own range (P0.1 .. P99.9). `warnings`: LUTs that are left out.
std::vector<NamedGrey> readGreys(const DataSet& data, const FrameScopes& at, const FileHeader& header,
                                 const Slice& slice, const Frame& frame, std::vector<std::string>& warnings);

}  // namespace volumen::dicom
