#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// Largest number of frames that a file may claim.
inline constexpr int frameLimit = 1'000'000;

/// Fills in patient, study, series and UIDs.
void readIdentity(const DataSet& data, FileHeader& header);

/// Reads the Image Pixel Module of a data set whose pixel data is `pixels`. `begin` holds the first bytes of
/// native pixels, which may reveal a sign that the file does not state. `warnings` receives assumptions for
/// missing attributes. An Error names an attribute that is missing, wrong or not supported (1-bit colours,
/// colours that are not in use).
Result<PixelFormat> readPixelFormat(const DataSet& data, const Element& pixels, Bytes begin,
                                    std::vector<std::string>& warnings);

/// Returns ContrastBolusAgent, else the meaning of the first agent's code; empty if no agent is named.
std::string readContrastAgent(const DataSet& data);

/// Returns the playback timing of a clip of `frames` frames.
Cine readCine(const DataSet& data, int frames);

/// Fills in position and rescale of each frame, or why the frames are no slices (notVolume). Returns an Error
/// if a rescale cannot be determined.
Status readSlices(const DataSet& data, FileHeader& header);

}  // namespace volumen::dicom
