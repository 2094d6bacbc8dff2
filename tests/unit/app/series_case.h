#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <set>

#include "tests/unit/app/slice_case.h"

namespace volumen::tests {

/// Parallel planes, `distance` mm apart.
struct TwinStack {
  TwinPlane first;
  int count = 1;
  double distance = 1;

  TwinPlane plane(int n) const;
};

/// Places planes like `first` so that they cover the box of voxels along their normal, centred on it.
TwinStack stackAcross(const VoxelGeometry& geometry, const TwinPlane& first, double distance);

/// A slice as it is in its file, read by DCMTK alone.
struct StoredFile {
  explicit StoredFile(const QString& path);
  std::string said(const DcmTagKey& tag);
  std::vector<double> numbers(const DcmTagKey& tag);
  double number(const DcmTagKey& tag, double otherwise);
  std::vector<double> values();
  /// Returns the SOP Instance UIDs of the source images.
  std::vector<std::string> sources();

  DcmFileFormat file;
};

/// Returns the files in a folder by name.
QStringList storedFilesIn(const QString& folder);

/// Returns the errors that dciodvfy finds in the middle file of a folder but not in the first of `source`,
/// without those on how a source was de-identified.
QStringList newErrorsInMiddle(const QString& folder, const QString& source);

/// Returns a number with all its digits.
QString exactText(double number);

/// Describes the first slice in a folder that lies elsewhere than in the stack, or whose values are not those
/// of `volumen slice` of `source` within half a step of the rescale; empty if none does. Values are compared
/// for the slices in `compared`. Pixels outside of the volume must all have one value. `ofSeries`: further
/// options.
QString stackFaults(const QString& folder, const QString& source, const QStringList& ofSeries,
                    const TwinStack& stack, const std::set<int>& compared);

}  // namespace volumen::tests
