#include "ui/exports/views_picture.h"

#include <algorithm>

#include "ui/views/flat_view.h"
#include "ui/views/volume_view.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

class ViewsPicture : public QObject, public PictureMaker {
 public:
  ViewsPicture(const std::vector<View*>& views, const Session& session,
               const std::function<MadePicture()>& capture)
      : views_(views), capture_(capture) {
    for (View* view : views) {
      if (auto* flat = qobject_cast<FlatView*>(view))
        connect(flat, &FlatView::settled, this, &ViewsPicture::look);
      else if (auto* scene = qobject_cast<VolumeView*>(view))
        connect(scene, &VolumeView::drawn, this, &ViewsPicture::look);
    }
    whenChanged(session, this, &ViewsPicture::miss, std::not_equal_to<Workspace>());
    connect(&session, &Session::preferencesChanged, this, &ViewsPicture::miss);
    look();
  }

  void make(std::size_t, JobLane&, const Done& done) override {
    done_ = done;
    tell();
  }

 private:
  void look() {
    const auto isDrawn = [](const View* view) { return view->hasItsPicture(); };
    if (!made_ && std::ranges::all_of(views_, isDrawn)) made_ = capture_();
    tell();
  }
  void miss() {
    if (!made_)
      made_ = Error{tr("The view changed before it was drawn: ask for its picture again.").toStdString()};
    tell();
  }
  void tell() {
    if (made_ && done_) std::exchange(done_, {})(*made_);
  }

  const std::vector<View*> views_;
  const std::function<MadePicture()> capture_;
  std::optional<Result<MadePicture>> made_;
  Done done_;  // set while an answer is expected
};

}  // namespace

PictureMakerPtr viewsPicture(const std::vector<View*>& views, const Session& session,
                             const std::function<MadePicture()>& capture) {
  return std::make_shared<ViewsPicture>(views, session, capture);
}

}  // namespace volumen
