#pragma once

#include "io/index/database.h"
#include "io/index/index.h"

namespace volumen {

/// What Index::studies, series, files and refusedBeside give.
std::vector<IndexedStudy> findStudies(Database& db, const StudyQuery& query);
std::vector<IndexedSeries> findSeriesOf(Database& db, std::int64_t study);
/// The middle file of the first volume of a series, or of all its pictures; empty: it has none.
std::string middleFile(Database& db, std::int64_t series);
std::vector<std::string> findFilesOf(Database& db, std::int64_t study, std::int64_t series);
std::vector<std::string> findRefusedBeside(Database& db, std::int64_t study, std::int64_t series);

}  // namespace volumen
