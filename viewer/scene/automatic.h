#pragma once

#include "viewer/volume/histogram.h"

namespace volumen {

/// The values most voxels have: P1 .. P99.5, padding left out (design.md 10), from a fine histogram; all
/// values where those are one.
ValueRange usualRange(const Volume& volume);

/// Whether values are Hounsfield units by the look of them: a mode of air between -1100 and -900, nothing
/// below what scanners write outside their circle, and matter above 0.
bool looksLikeHounsfield(const Histogram& histogram);

/// The value of water: 1024 of a CT that lacks the rescale which makes Hounsfield units of its values (air is
/// then at 0), else 0.
double waterOf(const Volume& volume);

/// Whether the volume's values are Hounsfield units: it is a CT with its rescale, or no modality is known and
/// they look like it. `histogram`: the volume's.
bool inHounsfield(const Volume& volume, const Histogram& histogram);

/// CT with contrast medium: its blood makes a second hump above soft tissue, so the counts rise again
/// somewhere between 130 and 450 HU; without it they only fall.
bool hasContrast(const Histogram& histogram);

/// CT of the chest: more than a tenth of what is not air is lung (-900 .. -600 HU).
bool isChest(const Histogram& histogram);

/// CT of a head or limb: more than 9 % of what is neither air nor lung is bone above 300 HU.
bool isBony(const Histogram& histogram);

}  // namespace volumen
