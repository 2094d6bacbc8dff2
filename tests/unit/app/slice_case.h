#pragma once

#include <QString>
#include <QStringList>
#include <vector>

#include "tests/fixtures/slice_twin.h"

namespace volumen::tests {

/// What a run of `volumen slice PATH -o x.nrrd OPTIONS` gave.
struct SliceFile {
  QString failure;  ///< why there are no values; empty where there are
  glm::ivec2 size{0};
  std::vector<float> values;  ///< row by row from the top, NaN outside
  QByteArray plane;           ///< what --print-plane wrote
};

/// Runs it in a folder of its own.
SliceFile runSlice(const QString& path, const QStringList& options);

/// The options of `volumen slice` that ask for slab, interpolation and averaging of `plane`.
QStringList samplingOptions(const TwinPlane& plane);
/// The options that ask for all of `plane`, in numbers.
QStringList planeOptions(const TwinPlane& plane);

/// Where the plane that was told or the values are not the twin's: pixels without a value where the twin has
/// one (or the reverse), and values further off than 1e-4 of the volume's range (and what float32 rounds
/// off). A pixel passes if the twin gives it with all samples moved by 1e-6 voxel: what hangs on less hangs
/// on rounding. Empty: none.
QString faultsOf(const SliceFile& slice, const Volume& volume, const TwinPlane& plane);

/// The volume that a flat view shows of the path, chosen as the program chooses without --series; null where
/// `path` is empty.
VolumePtr volumeAt(const std::string& path);

/// The pixel of a PNG on which the grey differs from the twin's of the values, in words; empty where none
/// does. Values whose grey lies within 1e-3 of a boundary between two bytes may have either.
QString greyFaults(const QString& png, const SliceFile& slice, Window window, bool linearExact);

}  // namespace volumen::tests
