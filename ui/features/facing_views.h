#pragma once

#include <QObject>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "ui/controller/frame_service.h"
#include "ui/workspace/facing.h"
#include "ui/workspace/session.h"

namespace volumen {

class ViewGrid;

/// Turns, moves and scales frames as their hanging protocol says: once they are loaded, in the undo step of
/// the hanging, and again without a step after views are resized.
class FacingViews : public QObject {
  Q_OBJECT
 public:
  FacingViews(Session& session, ViewGrid& grid, const FrameService& frames, QObject* parent);

  /// Forgets the protocol, as the views no longer belong to one.
  void forget();
  /// Begins with a protocol that has just been hung.
  void begin(const HangingProtocol& protocol);

 private:
  // Frames of the protocol's cells, and the views that show them.
  struct HungFrames {
    std::vector<FacingFrame> frames;
    std::vector<ViewId> ids;
  };
  // The looks that facing left at each hanging and view size. Undo may restore any of them.
  struct FacedViews {
    HangingProtocol protocol;
    std::map<ViewId, std::vector<std::pair<SeriesKey, FlatLook>>> looks;
  };

  void soon();
  std::optional<HungFrames> framesOf(const HangingProtocol& protocol) const;
  bool liesAsLeft(const FacedViews& faced, ViewId view) const;
  Workspace facedNow(FacedViews& faced, const HungFrames& hung, bool all);
  FacedViews& facedBy(const HangingProtocol& protocol);
  void face();
  void faceAgain();

  Session& session_;
  ViewGrid& grid_;
  // The protocol that waits for its frames, and the views as it hung them.
  std::optional<HangingProtocol> waiting_;
  SharedList<ViewState> hungViews_;
  std::set<FrameKey> unreadable_;  // frames that failed since the hanging
  std::vector<FacedViews> faced_;  // one entry per protocol
};

}  // namespace volumen
