#pragma once

#include <optional>

#include "ui/main_window.h"
#include "ui/views/volume_view.h"

namespace volumen::tests {

/// Reports when the 3D view of a window shows its final picture: no draft, and of the present scene. It sees
/// only pictures drawn after its own construction.
class FinalPicture : public QObject {
 public:
  explicit FinalPicture(MainWindow& window) : scenes_(window.document().drawn), view_(window.view()) {
    connect(view_, &VolumeView::drawn, this, [this](const ScreenPicture& picture) {
      if (picture.atRest) rest_ = picture;
    });
  }
  bool isThere() const {
    if (!rest_ || rest_->image.size() != view_->pixels()) return false;
    Scene now = scenes_.scene(view_->id());
    if (!now.camera) now.camera = rest_->scene.camera;
    return rest_->scene == now && rest_->volume == scenes_.series(view_->id())->volume;
  }

 private:
  const DrawnScenes& scenes_;
  VolumeView* const view_;
  std::optional<ScreenPicture> rest_;
};

}  // namespace volumen::tests
