#include "ui/features/facing_views.h"

#include <algorithm>

#include "results/text/text.h"
#include "ui/views/frame_view.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/edit_workspace.h"

namespace volumen {

namespace {

bool wantsFrames(const HangingProtocol& protocol) {
  return protocol.sameScale || std::ranges::any_of(protocol.cells, [](const ProtocolCell& cell) {
           return cell.chestWall != ChestWall::anywhere;
         });
}

// Resets what does not move the picture, so that looks compare equal by position and size.
FlatLook placed(FlatLook look) {
  look.inverted = look.nearest = false;
  look.layers = true;
  return look;
}

}  // namespace

FacingViews::FacingViews(Session& session, ViewGrid& grid, const FrameService& frames, QObject* parent)
    : QObject(parent), session_(session), grid_(grid) {
  connect(&frames, &FrameService::ready, this, &FacingViews::soon);
  connect(&frames, &FrameService::failed, this, [this](int, const FrameKey& key) {
    unreadable_.insert(key);
    soon();
  });
  connect(&grid_, &ViewGrid::arranged, this, &FacingViews::soon);
  // Undo may restore looks made for another view size.
  connect(&session_.undoStack(), &QUndoStack::indexChanged, this, &FacingViews::soon);
}

// Runs after the views have taken their frames and sizes.
void FacingViews::soon() {
  if (waiting_) QMetaObject::invokeMethod(this, &FacingViews::face, Qt::QueuedConnection);
  if (!faced_.empty()) QMetaObject::invokeMethod(this, &FacingViews::faceAgain, Qt::QueuedConnection);
}

void FacingViews::forget() {
  waiting_.reset();
  unreadable_.clear();
}

void FacingViews::begin(const HangingProtocol& protocol) {
  if (!wantsFrames(protocol)) return;
  waiting_ = protocol;
  hungViews_ = session_.workspace().views;
  soon();
}

// Returns the hung frames, or nothing until all readable frames are loaded.
std::optional<FacingViews::HungFrames> FacingViews::framesOf(const HangingProtocol& protocol) const {
  const Workspace& workspace = session_.workspace();
  const std::vector<ViewId> views = viewsInMain(workspace);
  HungFrames hung;
  for (std::size_t n = 0; n < std::min(views.size(), protocol.cells.size()); ++n) {
    const ViewState& state = workspace.view(views[n]);
    if (state.series.empty() || !showsFrames(state.kind)) continue;
    const FlatLook look = flatLookOf(state);
    const FrameKey key{state.series, look.frame, look.presentation.path};
    if (unreadable_.contains(key)) continue;
    const auto* view = grid_.viewAs<FrameView>(views[n]);
    if (!view || !view->frame() || view->frame()->key != key) return {};
    const QSize pixels = view->pixels();
    hung.frames.push_back(
        {view->frame(), look, {pixels.width(), pixels.height()}, protocol.cells[n].chestWall});
    hung.ids.push_back(views[n]);
  }
  return hung;
}

bool FacingViews::liesAsLeft(const FacedViews& faced, ViewId view) const {
  const auto left = faced.looks.find(view);
  const ViewState& state = session_.workspace().view(view);
  return left != faced.looks.end() &&
         std::ranges::find(left->second, std::pair(state.series, placed(flatLookOf(state)))) !=
             left->second.end();
}

// Skips views that the user has moved since they were faced, unless `all`.
Workspace FacingViews::facedNow(FacedViews& faced, const HungFrames& hung, bool all) {
  const std::vector<FlatLook> looks = facingLooks(hung.frames, faced.protocol.sameScale);
  Workspace after = session_.workspace();
  for (std::size_t n = 0; n < hung.ids.size(); ++n) {
    const ViewId id = hung.ids[n];
    const SeriesKey series = after.view(id).series;
    if (!all && !liesAsLeft(faced, id)) continue;
    if (looks[n] != hung.frames[n].look) after.editView(id).flats.editOrAdd(series) = looks[n];
    const std::pair left(series, placed(looks[n]));
    auto& known = faced.looks[id];
    if (std::ranges::find(known, left) == known.end()) known.push_back(left);
  }
  return after;
}

FacingViews::FacedViews& FacingViews::facedBy(const HangingProtocol& protocol) {
  const auto isIt = [&](const FacedViews& faced) { return faced.protocol == protocol; };
  const auto known = std::ranges::find_if(faced_, isIt);
  return known == faced_.end() ? faced_.emplace_back(FacedViews{protocol, {}}) : *known;
}

// Turns mammograms to face each other and equalises sizes once all frames are loaded, unless views were
// changed meanwhile.
void FacingViews::face() {
  if (!waiting_) return;
  if (session_.workspace().views != hungViews_) return waiting_.reset();
  const std::optional<HungFrames> hung = framesOf(*waiting_);
  if (!hung) return;
  FacedViews& faced = facedBy(*waiting_);
  waiting_.reset();
  session_.change(tr("Hang as %1").arg(shownText(faced.protocol.name)), facedNow(faced, *hung, true),
                  facedKey);
}

// Repeats facing after views were resized, without an undo step.
void FacingViews::faceAgain() {
  if (waiting_) return;  // hanging comes first
  const auto isOnScreen = [this](const FacedViews& faced) {
    return faced.protocol.layout == session_.workspace().layout &&
           std::ranges::any_of(faced.looks, [&](const auto& left) { return liesAsLeft(faced, left.first); });
  };
  const auto faced = std::ranges::find_if(faced_, isOnScreen);
  if (faced == faced_.end()) return;
  if (const std::optional<HungFrames> hung = framesOf(faced->protocol))
    session_.adapt(facedNow(*faced, *hung, false));
}

}  // namespace volumen
