#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ui/workspace/view_id.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// Where a study of the index is shown: in the view in focus, there in place of other patients, in the view
/// beside it, or nowhere. A study that is only looked into is listed by the requester if it matches.
enum class OpenHow { here, instead, beside, lookedInto };

/// The purpose of opening something. It travels with the request and returns with the answer, because other
/// requests may come in between.
struct OpenIntent {
  OpenHow how = OpenHow::here;
  std::string seriesUid{};       ///< the series to show; empty for the largest, or the first pictures
  std::optional<Scene> scene{};  ///< scene to show it with
  std::shared_ptr<bool>
      isShown{};                 ///< for items opened together: whether any was shown; null for a single item
  bool isAlone = false;          ///< whether it is the whole request
  std::optional<ViewId> onto{};  ///< the view with a series that it was dropped on
};

}  // namespace volumen
