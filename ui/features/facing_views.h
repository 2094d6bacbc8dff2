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

/// Turns, moves and enlarges the frames that a protocol hung as it says: once they are there, in the step of
/// their hanging, and again, without a step, where views have another size.
class FacingViews : public QObject {
  Q_OBJECT
 public:
  FacingViews(Session& session, ViewGrid& grid, const FrameService& frames, QObject* parent);

  /// The views are no longer those of a protocol.
  void forget();
  /// This one was hung now.
  void begin(const HangingProtocol& protocol);

 private:
  // The frames of cells, and the views that show them.
  struct HungFrames {
    std::vector<FacingFrame> frames;
    std::vector<ViewId> ids;
  };
  // How the views of a protocol were left whenever it was hung and at each size: undo brings back any of
  // these.
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
  // What waits for its frames: the protocol, and the views as it hung them.
  std::optional<HangingProtocol> waiting_;
  SharedList<ViewState> hungViews_;
  std::set<FrameKey> unreadable_;  // since it was hung
  std::vector<FacedViews> faced_;  // one a protocol
};

}  // namespace volumen
