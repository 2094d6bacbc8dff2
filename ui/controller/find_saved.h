#pragma once

#include "ui/workspace/session_json.h"

namespace volumen {

struct Study;

/// Returns all series a saved session may refer to: series as read, frames with single pictures stacked
/// (withPictureStacks()), and the same frames unstacked, for older sessions.
std::vector<Series> allSeriesOf(const Study& study);

/// Returns the series that is unchanged, identified by its UID or id and its proof. A series along a curve is
/// identified by its source. Ids may have changed with neighbouring files. Returns null if there is none.
const Series* findSaved(const std::vector<Series>& all, const SavedSeries& saved);

/// Returns the series with the saved name, whatever it contains now; null if there is none.
const Series* namesakeOf(const std::vector<Series>& all, const SavedSeries& saved);

/// Returns the object with the saved UID; null if there is none.
const DerivedObject* findSaved(const Study& study, const SavedObject& saved);

}  // namespace volumen
