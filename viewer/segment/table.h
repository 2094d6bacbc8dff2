#pragma once

#include <optional>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Threshold above air, lung and foam, HU.
inline constexpr double notAirHu = -300;

/// Returns the grid axis (0, 1 or 2) closest to the patient's head-to-feet axis.
int axisAlongPatient(const VoxelGeometry& geometry);

/// Returns the patient in a CT, without the table: the largest connected component above notAirHu. Holes in
/// its slices (lungs, bowel) are filled, and it is grown by about 3 mm to keep the edge of the skin. Empty if
/// nothing is above notAirHu. Values must be HU.
BitMask patientMask(const Volume& volume, const CancelToken& cancel = {});

/// Returns the patient in a CT for a picture without the table. It extends patientMask() by all components,
/// such as the other leg, that are at least a tenth as large as the largest and thicker than a shell. Empty
/// if less than half a percent of the voxels above notAirHu would be left out: there is no table. Values must
/// be HU.
std::optional<BitMask> patientBesideTable(const Volume& volume, const CancelToken& cancel = {});

}  // namespace volumen
