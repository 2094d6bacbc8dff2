#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ui/workspace/view_id.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// Where a study of the index is shown: in the view in focus, there and in place of other patients, in the
/// view beside, or nowhere: whoever asked for it looks into it, and lists it where it is what was looked for.
enum class OpenHow { here, instead, beside, lookedInto };

/// What something is opened for. It travels with the request and comes back with the answer: others may be
/// asked for meanwhile.
struct OpenIntent {
  OpenHow how = OpenHow::here;
  std::string seriesUid{};       ///< the series to show; empty: the largest, or the first pictures
  std::optional<Scene> scene{};  ///< to show it by
  std::shared_ptr<bool>
      isShown{};         ///< of what is opened together: whether any of it was shown; null: nothing is
  bool isAlone = false;  ///< it is all that was asked for
  std::optional<ViewId> onto{};  ///< the view with a series that it was dropped on
};

}  // namespace volumen
