#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/workspace/view_id.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// Where a study of the index is shown: in the view in focus, there in place of other patients, in the view
/// beside it, or nowhere. A study that is only looked into is listed by the requester if it matches. More of
/// a study that is being opened only joins the list, if the study is still in it.
enum class OpenHow { here, instead, beside, lookedInto, joining };

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
  std::vector<std::string> files{};  ///< those that are read for it, if they are not one path
};

}  // namespace volumen
