#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/study/unread.h"

namespace volumen {

struct Series;
struct Study;

/// A series of `info`: what was found, and the same as JSON, with its values where they were asked for.
struct InfoSeries {
  const Series* series;
  nlohmann::ordered_json json;
  std::vector<Unread> unread = {};  ///< what is lost of it
};

/// What PATH holds in the words of the window: patients, studies, series with their warnings, and what could
/// not be read. `verbose`: also ids, folders and every file that is not shown; else the first few of these.
std::string infoText(const Study& study, const std::vector<InfoSeries>& series, bool verbose);

}  // namespace volumen
