#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "ui/workspace/view_id.h"

namespace volumen {

/// What the render thread does, the first first.
enum class Work {
  draft,  ///< what a view shows at once, within the frame time
  first,  ///< a picture of a view by plain steps, where its picture at rest will take long
  rest,   ///< the picture at rest of a view
  saved,
  trial,
  thumbnail
};

/// A view whose picture at rest is not drawn yet.
struct WaitingView {
  ViewId view = 0;
  Work next = Work::draft;              ///< or first, or rest
  std::chrono::milliseconds waited{0};  ///< since its last draft was begun, else since it was asked for
};

/// All that waits to be drawn.
struct Waiting {
  std::vector<WaitingView> views;
  std::optional<ViewId> gestureView;  ///< the view of the last gesture
  bool saved = false, trial = false, thumbnail = false;
};

struct Turn {
  Work work;
  ViewId view = 0;  ///< where it is done for one
  bool operator==(const Turn&) const = default;
};

/// A draft that has waited for longer goes before that of the view of the last gesture, so that views which
/// follow it are drawn, too.
inline constexpr std::chrono::milliseconds longestWait{250};

/// What is drawn next, in the order of Work; among views that of the last gesture, then the one that has
/// waited for longest. Nothing where nothing waits.
std::optional<Turn> nextTurn(const Waiting& waiting);

}  // namespace volumen
