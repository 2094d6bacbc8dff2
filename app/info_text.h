#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/study/unread.h"

namespace volumen {

struct Series;
struct Study;

/// A series for `info`: the series itself, and its JSON, with values if requested.
struct InfoSeries {
  const Series* series;
  nlohmann::ordered_json json;
  std::vector<Unread> unread = {};  ///< unreadable files
};

/// Returns the contents of PATH in the window's words: patients, studies, series with their warnings, and
/// unreadable files. `verbose` adds ids, folders and every file that is not displayed; else only the first
/// few are listed.
std::string infoText(const Study& study, const std::vector<InfoSeries>& series, bool verbose);

}  // namespace volumen
