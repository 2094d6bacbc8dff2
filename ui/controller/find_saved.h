#pragma once

#include "ui/workspace/session_json.h"

namespace volumen {

struct Study;

/// All that a session may know of a study as it was read, whenever it was saved: its series, the frames of
/// what is none with its pictures stacked (withPictureStacks()), and as they were before there were stacks.
std::vector<Series> allSeriesOf(const Study& study);

/// The series that is what it was, of one along a curve its source, by its UID or id and what tells that it
/// is the same; ids may have changed with what lies beside it. Null: none is.
const Series* findSaved(const std::vector<Series>& all, const SavedSeries& saved);

/// One of its name, whatever it holds by now; null: there is none.
const Series* namesakeOf(const std::vector<Series>& all, const SavedSeries& saved);

/// The object of this UID; null: there is none.
const DerivedObject* findSaved(const Study& study, const SavedObject& saved);

}  // namespace volumen
