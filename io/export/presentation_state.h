#pragma once

#include <string>
#include <vector>

#include "io/export/study_object.h"
#include "io/presentation.h"
#include "viewer/slice/frame.h"

namespace volumen {

/// Writes how pictures of a series are shown as a Grayscale Softcopy Presentation State (PS3.3 A.33.1) into
/// a new file. loadPresentation() reads the same back.
/// A presentation without pictures applies to all of the series. Multi-frame files are referenced by frames.
/// The date is that of `tags`. `frame` is one of the pictures; its values are not needed. Its size is the
/// displayed area by default, and its pixel size or aspect ratio is written.
/// Returns notes for the user about properties that such an object cannot hold. Returns an Error if `path`
/// exists or cannot be written, or if the export was cancelled. Also returns an Error if the series is not
/// from DICOM files or lacks a picture, or if pictures are in colour or have no UIDs of their own
/// (checkNames()).
Result<std::vector<std::string>> writePresentationState(const Presentation& presentation,
                                                        const Series& series, const Frame& frame,
                                                        const ObjectTags& tags, const std::string& path,
                                                        const Progress& progress = {},
                                                        const CancelToken& cancel = {});

}  // namespace volumen
