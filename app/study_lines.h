#pragma once

#include <nlohmann/json.hpp>

#include "app/text_table.h"
#include "io/index/index.h"

namespace volumen {

/// Return a study and a series as JSON, of the index or of an archive.
nlohmann::ordered_json studyJson(const IndexedStudy& study);
nlohmann::ordered_json seriesJson(const IndexedSeries& series);

/// Tables of studies and of series. Each row of the latter names the series' study.
TextTable studyTable();
void addTo(TextTable& table, const IndexedStudy& study);
TextTable seriesTable();
void addTo(TextTable& table, const IndexedStudy& study, const IndexedSeries& series);

}  // namespace volumen
