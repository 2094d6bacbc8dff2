#pragma once

#include "viewer/volume/histogram.h"

namespace volumen {

/// Returns the usual value range: P1 .. P99.5 without padding (design.md 10) from a fine histogram, or all
/// values if these are equal.
ValueRange usualRange(const Volume& volume);

/// Returns whether values look like Hounsfield units: an air mode between -1100 and -900, nothing below the
/// values that scanners write outside their circle, and matter above 0.
bool looksLikeHounsfield(const Histogram& histogram);

/// Returns the value of water: 1024 for a CT that lacks the rescale to Hounsfield units (air is then at 0),
/// else 0.
double waterOf(const Volume& volume);

/// Returns whether values are Hounsfield units: a CT with its rescale, or no known modality but values that
/// look like it. `histogram` is that of the volume.
bool inHounsfield(const Volume& volume, const Histogram& histogram);

/// Returns whether a CT has contrast medium. Blood then forms a second hump above soft tissue: counts rise
/// again between 130 and 450 HU, where they otherwise only fall.
bool hasContrast(const Histogram& histogram);

/// Returns whether a CT shows the chest: more than a tenth of all voxels but air are lung (-900 .. -600 HU).
bool isChest(const Histogram& histogram);

/// Returns whether a CT shows a head or limb: above 9 % of all voxels but air and lung are bone over 300 HU.
bool isBony(const Histogram& histogram);

}  // namespace volumen
