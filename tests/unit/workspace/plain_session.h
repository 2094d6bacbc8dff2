#pragma once

#include <QString>
#include <nlohmann/json.hpp>

#include "ui/workspace/session_json.h"

namespace volumen::tests {

/// Folder in which the sessions claim to be.
inline const std::string sessionFolder = "/data";

/// Returns the session of a window that shows one series.
inline nlohmann::ordered_json plainSession() {
  Series series;
  series.path = sessionFolder + "/ct";
  series.id = "1.2.3";
  series.format = "DICOM";
  return nlohmann::ordered_json::parse(
      *sessionToJson(withSeries({}, sceneViewId, series, {}), sessionFolder));
}

/// Returns why a text is not a session; empty if it is one.
inline QString whyNoSession(const std::string& text) {
  const auto session = sessionFromJson(text, {});
  return session ? QString() : QString::fromStdString(session.message());
}

}  // namespace volumen::tests
