#pragma once

#include <functional>
#include <string>

#include "io/files/nifti_write.h"
#include "io/files/nrrd_write.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Writes a volume as `path` ends: .nrrd (gzip), .nii.gz (NIfTI-1) or .mha. The file appears whole or not at
/// all. Values are exact: stored integers (with slope and intercept in NIfTI where its float32 holds them),
/// real values as integers where they are whole, else float32. Geometry is exact in .nrrd, to the last bit of
/// a double in .mha, and to float32 in NIfTI, which knows no more. An Error names the file: unknown ending,
/// cannot be written, more than 32767 voxels along an axis (NIfTI).
Status writeVolume(const Volume& volume, const std::string& path, const Progress& progress = {},
                   const CancelToken& cancel = {});

/// The same as NRRD, whatever the ending, with key/value pairs of the caller's. Keys hold no ":=" and no line
/// end.
Status writeNrrd(const Volume& volume, const std::string& path, const NrrdKeyValues& keyValues,
                 const Progress& progress = {}, const CancelToken& cancel = {});

/// A volume of several, from 0; asked for in order, and perhaps all once more.
using VolumeAt = std::function<Result<VolumePtr>(int)>;

/// Writes the volumes of one grid as one 4-D NIfTI-1 file (gzip): stored integers where all have one rescale,
/// else float32. An Error where a volume lies on another grid.
Status writeNiftiVolumes(const NiftiTime& time, const VolumeAt& volumeAt, const std::string& path,
                         const Progress& progress = {}, const CancelToken& cancel = {});

/// Whether writeVolume knows the ending of `path`.
bool isVolumeFileName(const std::string& path);

}  // namespace volumen
