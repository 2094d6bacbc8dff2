#pragma once

#include "io/study/study.h"

namespace volumen {

/// The same study with its single pictures stacked: where a series holds several volumes, or volumes and
/// images, and each of them opens as pictures and is told from the others by size, direction or place alone
/// (radiographs of several sizes, localizers in three planes), its pictures are images in place of volumes,
/// so that they are one series of frames (frameSeries). Series told apart by what they show (echoes, time
/// points, kernels), PET, files of several frames, files without a series, of several patients, without
/// SOPInstanceUIDs of their own, or with places in several frames of reference, and slices that a gap alone
/// parts stay as they are. Nothing changes where that was done before.
Study withPictureStacks(Study study);

}  // namespace volumen
