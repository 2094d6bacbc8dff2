#pragma once

#include <functional>
#include <string>

#include "io/files/nifti_write.h"
#include "io/files/nrrd_write.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Writes a volume in the format of the path's ending: .nrrd (gzip), .nii.gz (NIfTI-1) or .mha. The file
/// appears whole or not at all. Values are exact: stored integers (with slope and intercept in NIfTI if its
/// float32 holds them), real values as integers if they are whole, else float32. Geometry is exact in .nrrd,
/// to the last bit of a double in .mha, and rounded to float32 in NIfTI. The Error names the file: unknown
/// ending, cannot be written, more than 32767 voxels along an axis (NIfTI).
Status writeVolume(const Volume& volume, const std::string& path, const Progress& progress = {},
                   const CancelToken& cancel = {});

/// Writes a volume as NRRD for any ending, with the caller's key/value pairs. Keys must not hold ":=" or line
/// ends.
Status writeNrrd(const Volume& volume, const std::string& path, const NrrdKeyValues& keyValues,
                 const Progress& progress = {}, const CancelToken& cancel = {});

/// Returns one of several volumes, from 0. Called in order, and possibly for all a second time.
using VolumeAt = std::function<Result<VolumePtr>(int)>;

/// Writes the volumes of one grid as one 4-D NIfTI-1 file (gzip): stored integers if all share one rescale,
/// else float32. The Error: a volume has another grid.
Status writeNiftiVolumes(const NiftiTime& time, const VolumeAt& volumeAt, const std::string& path,
                         const Progress& progress = {}, const CancelToken& cancel = {});

/// True if writeVolume() knows the ending of `path`.
bool isVolumeFileName(const std::string& path);

}  // namespace volumen
