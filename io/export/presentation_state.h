#pragma once

#include <string>
#include <vector>

#include "io/export/study_object.h"
#include "io/presentation.h"
#include "viewer/slice/frame.h"

namespace volumen {

/// Writes how pictures of a series are shown as a grayscale softcopy presentation state (PS3.3 A.33.1) into a
/// new file. `presentation` is what loadPresentation() reads back; without pictures it is for all of the
/// series. Frames are named of files that have several. Its date is not used: `tags` have one. `frame` is one
/// of its pictures, with or without values: its size is the area shown where none is given, and its pixel
/// size or aspect ratio is written. Returns notes for the user: what such an object cannot hold. The Error:
/// the path exists or cannot be written, the series is not from DICOM files or has no such picture, its
/// pictures are in colour or have no UIDs of their own (checkNames()), or the export was cancelled.
Result<std::vector<std::string>> writePresentationState(const Presentation& presentation,
                                                        const Series& series, const Frame& frame,
                                                        const ObjectTags& tags, const std::string& path,
                                                        const Progress& progress = {},
                                                        const CancelToken& cancel = {});

}  // namespace volumen
