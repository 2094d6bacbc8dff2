#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "ui/workspace/view_id.h"

namespace volumen {

/// Tasks of the render thread, in order of priority.
enum class Work {
  draft,  ///< the immediate picture of a view, within the frame time
  finer,  ///< a finer draft, if its picture at rest will take long
  rest,   ///< the picture at rest of a view
  saved,
  trial,
  thumbnail
};

/// A view whose picture at rest is not drawn yet.
struct WaitingView {
  ViewId view = 0;
  Work next = Work::draft;              ///< draft, finer or rest
  std::chrono::milliseconds waited{0};  ///< since the start of its last draft, else since the request
};

/// All waiting tasks.
struct Waiting {
  std::vector<WaitingView> views;
  std::optional<ViewId> gestureView;  ///< the view of the last gesture
  bool saved = false, trial = false, thumbnail = false;
};

struct Turn {
  Work work;
  ViewId view = 0;  ///< for tasks of a view
  bool operator==(const Turn&) const = default;
};

/// A draft that has waited longer precedes the draft of the view of the last gesture, so that linked views
/// are drawn too.
inline constexpr std::chrono::milliseconds longestWait{250};

/// Returns the next task in the order of Work. Among views, the view of the last gesture comes first, then
/// the one that has waited longest. Returns nothing if nothing waits.
std::optional<Turn> nextTurn(const Waiting& waiting);

}  // namespace volumen
