#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// The most frames that a file may claim.
inline constexpr int frameLimit = 1'000'000;

/// Fills in who and what: patient, study, series, UIDs.
void readIdentity(const DataSet& data, FileHeader& header);

/// The Image Pixel Module of a data set whose pixels stand in `pixels`; `begin`: the first bytes of native
/// ones, where a sign may show that is not said; `warnings`: what is taken for attributes that are missing.
/// An Error says which attribute is missing, wrong or of a kind that is not read (colours of one bit or of a
/// kind that is not in use).
Result<PixelFormat> readPixelFormat(const DataSet& data, const Element& pixels, Bytes begin,
                                    std::vector<std::string>& warnings);

/// ContrastBolusAgent, else what the codes of agents say; empty: none is named.
std::string readContrastAgent(const DataSet& data);

/// How the frames are to be played.
Cine readCine(const DataSet& data, int frames);

/// Fills in where each frame lies and how its values are rescaled, or why the frames are no slices
/// (notVolume). An Error where a rescale cannot be known.
Status readSlices(const DataSet& data, FileHeader& header);

}  // namespace volumen::dicom
