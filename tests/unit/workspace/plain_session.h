#pragma once

#include <QString>
#include <nlohmann/json.hpp>

#include "ui/workspace/session_json.h"

namespace volumen::tests {

/// Where sessions are said to lie.
inline const std::string sessionFolder = "/data";

/// The session of a window that shows one series.
inline nlohmann::ordered_json plainSession() {
  Series series;
  series.path = sessionFolder + "/ct";
  series.id = "1.2.3";
  series.format = "DICOM";
  return nlohmann::ordered_json::parse(
      *sessionToJson(withSeries({}, sceneViewId, series, {}), sessionFolder));
}

/// Why a text is no session; empty: it is one.
inline QString whyNoSession(const std::string& text) {
  const auto session = sessionFromJson(text, {});
  return session ? QString() : QString::fromStdString(session.message());
}

}  // namespace volumen::tests
