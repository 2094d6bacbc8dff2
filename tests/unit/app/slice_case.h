#pragma once

#include <QString>
#include <QStringList>
#include <vector>

#include "tests/fixtures/slice_twin.h"

namespace volumen::tests {

/// Result of `volumen slice PATH -o x.nrrd OPTIONS`.
struct SliceFile {
  QString failure;  ///< why there are no values, else empty
  glm::ivec2 size{0};
  std::vector<float> values;  ///< row by row from the top, NaN outside
  QByteArray plane;           ///< output of --print-plane
};

/// Runs the command in a temporary folder.
SliceFile runSlice(const QString& path, const QStringList& options);

/// Returns the options of `volumen slice` for slab, interpolation and averaging of `plane`.
QStringList samplingOptions(const TwinPlane& plane);
/// Returns all options for `plane`, in numbers.
QStringList planeOptions(const TwinPlane& plane);

/// Describes where the reported plane or the values differ from the twin's, empty if they agree. Compares
/// which pixels have a value, and values within 1e-4 of the volume's range and float32 rounding. A pixel also
/// passes if the twin gives its value with all samples moved by 1e-6 voxel, as smaller effects are rounding.
QString faultsOf(const SliceFile& slice, const Volume& volume, const TwinPlane& plane);

/// Returns the volume that a flat view shows of `path`, chosen as the program does without --series. Null if
/// `path` is empty.
VolumePtr volumeAt(const std::string& path);

/// Describes the pixel of a PNG whose grey differs from the twin's, empty if none does. Values whose grey is
/// within 1e-3 of a boundary between two bytes may have either.
QString greyFaults(const QString& png, const SliceFile& slice, Window window, bool linearExact);

}  // namespace volumen::tests
