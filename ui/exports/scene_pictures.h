#pragma once

#include "ui/controller/draw_service.h"
#include "ui/exports/picture_maker.h"
#include "ui/workspace/snapshot_request.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

/// Returns the measured error of exactly the picture of a plan, if it is known.
using MeasuredErrorOf = std::function<std::optional<MeasuredError>(const Plan& plan)>;

/// Makes a snapshot, or the pictures of a turntable or of time points. The render thread draws them. Their
/// texts contain the measured error, if it is known when they are drawn.
PictureMakerPtr scenePictures(DrawService& drawService, const SnapshotRequest& request,
                              const MeasuredErrorOf& measured);

}  // namespace volumen
