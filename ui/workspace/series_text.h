#pragma once

#include <QStringList>
#include <vector>

#include "viewer/segment/mask.h"
#include "viewer/segment/tissue_shown.h"

namespace volumen {

struct Series;
struct Warning;

/// Whether it is known which sides of the patient are left, front and top: letters and the names of planes
/// may stand for them.
bool knowsSides(const Series& series);

/// "axial", "coronal", "sagittal" or, more than 37 degrees off all of them, "oblique"; empty where the volume
/// is not calibrated.
QString planeText(const VoxelGeometry& geometry);

/// "28 slices, axial", "34 frames"; the plane where sides are known.
QString slicesText(const Series& series);

/// Whether two series of a study have the same name: those of a file by that file.
bool areNamesakes(const Series& a, const Series& b);

/// What tells a series apart from others of its name: the first of echo time, b-value, time point, label and
/// time of day that differ, "TE 20 ms", "b 1000", "time point 3", "direction 12", "10:22:31"; several where
/// none alone is enough, none where nothing does; side and view of single pictures always, "L CC". `others`:
/// of its name, itself included or not.
QStringList tellingApart(const Series& series, const std::vector<const Series*>& others);

/// All that is known of a series, one thing a line, warnings last: patient, study, values, place of its
/// files.
QStringList everythingOf(const Series& series);

/// What pictures of a series are made of, one thing a line: its name, slices, size and spacing, thickness and
/// unit of the values, each of these warnings last; of frames none that is of the volume they would make.
QStringList factsOf(const Series& series, const std::vector<Warning>& warnings);

/// What is to be known of a series beside what its picture says by itself: a sentence for each warning that
/// stands on no picture.
QStringList warningSentences(const std::vector<Warning>& warnings);

/// What was taken away from a series, each in two words: "table removed".
QStringList maskTexts(const Mask& mask);
/// Where its tissue is shown in 3D: "only inside segments, margin 2 mm"; empty: everywhere.
QString tissueText(const TissueShown& tissue);

}  // namespace volumen
