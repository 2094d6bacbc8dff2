#pragma once

#include <QStringList>
#include <vector>

#include "viewer/segment/mask.h"
#include "viewer/segment/tissue_shown.h"

namespace volumen {

struct Series;
struct Warning;

/// Returns whether it is known which sides of the patient are left, front and top, so that side letters and
/// plane names can be shown.
bool knowsSides(const Series& series);

/// Returns "axial", "coronal", "sagittal", or "oblique" if more than 37 degrees off all of them; empty if the
/// volume is not calibrated.
QString planeText(const VoxelGeometry& geometry);

/// Returns "28 slices, axial" or "34 frames"; the plane only if sides are known.
QString slicesText(const Series& series);

/// Returns thickness and distance of slices, "3 mm thick, 3.3 mm apart". An unknown thickness is left out,
/// and so is a distance that equals the thickness. If distances differ, the text says "unevenly apart".
QString thicknessText(const Series& series);

/// Returns whether two series of a study have the same name; if not DICOM, they must be of one file.
bool areNamesakes(const Series& a, const Series& b);

/// Returns what distinguishes a series from `others` of its name (with or without itself). That is the first
/// of echo time, b-value, time point, label and time of day that differs: "TE 20 ms", "b 1000", "time point
/// 3", "direction 12", "10:22:31". Returns several if one is not enough, none if nothing differs. Single
/// pictures always give laterality and view position, "L CC".
QStringList tellingApart(const Series& series, const std::vector<const Series*>& others);

/// Returns all known facts of a series, one per line: patient, study, values, location of its files; warnings
/// last.
QStringList everythingOf(const Series& series);

/// Returns the facts behind pictures of a series, one per line: name, slices, size and spacing, thickness,
/// unit of the values, then these warnings. For frames, leaves out warnings about the volume they would make.
QStringList factsOf(const Series& series, const std::vector<Warning>& warnings);

/// Returns a sentence for each warning that no picture shows by itself.
QStringList warningSentences(const std::vector<Warning>& warnings);

/// Returns what the mask removes from a series, in two words each: "table removed".
QStringList maskTexts(const Mask& mask);
/// Returns where tissue is shown in 3D: "only inside segments, margin 2 mm"; empty: everywhere.
QString tissueText(const TissueShown& tissue);

}  // namespace volumen
