#pragma once

#include "io/index/database.h"
#include "io/index/index.h"

namespace volumen {

/// These functions implement Index::studies, series, files and refusedBeside.
std::vector<IndexedStudy> findStudies(Database& db, const StudyQuery& query);
std::vector<IndexedSeries> findSeriesOf(Database& db, std::int64_t study);
/// Returns the middle file of the first volume of a series, or of all its images; empty if it has none.
std::string middleFile(Database& db, std::int64_t series);
std::vector<std::string> findFilesOf(Database& db, std::int64_t study, std::int64_t series);
std::vector<std::string> findRefusedBeside(Database& db, std::int64_t study, std::int64_t series);

}  // namespace volumen
