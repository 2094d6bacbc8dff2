#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// The mark that picture `index` (from 0) of a series has or would have; none where its file has no UID.
std::optional<KeyImage> keyImageOf(const Series& series, int index);

bool isKeyImage(const Workspace& workspace, const KeyImage& image);

/// Marked where it was not, and the other way round.
Workspace withKeyImageToggled(Workspace workspace, const KeyImage& image);

}  // namespace volumen
