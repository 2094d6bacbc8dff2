#pragma once

#include <set>

#include "results/segments/tissue.h"
#include "ui/document/derivation.h"
#include "ui/workspace/session.h"

namespace volumen {

class SegmentPainter;

/// Volumes that 3D views draw where tissue is left out, or the table of a CT.
using TissueLeft = Derivation<TissueKey, TissueVolume>;

/// Returns the rule for the volumes of 3D views on screen. A stroke is included once it ends. The table is
/// left out of CTs in `drawn` if memory has room for a second volume. `tissues` is the derivation that
/// follows this rule.
TissueLeft::Rule tissueLeftRule(const Session& session, const SegmentPainter& painter,
                                const std::set<SeriesKey>& drawn, const TissueLeft& tissues);

}  // namespace volumen
