#pragma once

#include "io/study/study.h"

namespace volumen {

/// Stacks the single pictures of a study. Its series with several volumes, or volumes and images, become one
/// series of frames (frameSeries): their pictures are images in place of volumes. All of them must open as
/// pictures and differ in size, direction or position alone. Examples are radiographs of several sizes and
/// localizers in three planes. Series separated by content (echoes, time points, kernels), PET, multi-frame
/// files and files without a series stay as they are. So do those of several patients, without
/// SOPInstanceUIDs of their own, with several frames of reference, or with slices separated by a gap alone. A
/// second call changes nothing.
Study withPictureStacks(Study study);

}  // namespace volumen
