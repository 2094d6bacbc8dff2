#pragma once

#include <optional>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What is above this is no air, lung or foam, HU.
inline constexpr double notAirHu = -300;

/// The axis of a grid that runs most along the patient (head to feet): 0, 1 or 2.
int axisAlongPatient(const VoxelGeometry& geometry);

/// The patient in a CT, without the table. The largest connected part of what is above notAirHu,
/// with all that it encloses in its slice (lungs, bowel) and grown by about 3 mm, so that the skin keeps its
/// edge. Empty where nothing is above notAirHu. Values must be HU.
BitMask patientMask(const Volume& volume, const CancelToken& cancel = {});

/// Returns the patient in a CT for a picture without the table: as patientMask(), but with all parts that are
/// at least a tenth as large as the largest and thicker than a shell, such as the other leg. None where
/// less than half a percent of what is above notAirHu would be left out: there is no table. Values must be
/// HU.
std::optional<BitMask> patientBesideTable(const Volume& volume, const CancelToken& cancel = {});

}  // namespace volumen
