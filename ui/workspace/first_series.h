#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

struct Study;

/// Returns the CT for a PET among open series: of its study and frame of reference, the one with most voxels.
/// Null if there is none.
const Series* ctUnder(const Workspace& workspace, const Series& pet, const std::vector<const Series*>& open);

/// Returns the PET of `study` that is shown over this CT; null if there is none.
const Series* petOver(const Workspace& workspace, const Series& ct, const Study& study,
                      const std::vector<const Series*>& open);

/// Returns the series that opening a study shows in the view in focus: the one with this UID, else the
/// largest volume, the PET over that CT where views show both, a larger stack, or the first pictures. `study`
/// is among `open`.
std::optional<Series> firstSeries(const Workspace& workspace, const Study& study,
                                  const std::vector<const Series*>& open, const std::string& seriesUid = {});

}  // namespace volumen
