#include "ui/features/once_drawn.h"

#include <algorithm>
#include <memory>

#include "ui/views/flat_view.h"
#include "ui/views/volume_view.h"

namespace volumen {

void onceDrawn(const std::vector<View*>& views, const Session& session, QObject* context,
               const std::function<void()>& take, const std::function<void()>& changed) {
  const auto areDrawn = [views] {
    return std::ranges::all_of(views, [](const View* view) { return view->hasItsPicture(); });
  };
  if (areDrawn()) return take();
  auto* waiting = new QObject(context);
  const auto end = [waiting, isOver = std::make_shared<bool>(false)](const std::function<void()>& call) {
    if (std::exchange(*isOver, true)) return;
    waiting->deleteLater();
    call();
  };
  const auto look = [areDrawn, end, take] {
    if (areDrawn()) end(take);
  };
  for (View* view : views) {
    if (auto* flat = qobject_cast<FlatView*>(view))
      QObject::connect(flat, &FlatView::settled, waiting, look);
    else if (auto* scene = qobject_cast<VolumeView*>(view))
      QObject::connect(scene, &VolumeView::drawn, waiting, look);
  }
  QObject::connect(&session, &Session::workspaceChanged, waiting,
                   [end, changed](const Workspace& before, const Workspace& after) {
                     if (!(before == after)) end(changed);
                   });
}

}  // namespace volumen
