#include "ui/views/view_makers.h"

#include <algorithm>

#include "ui/views/frame_view.h"
#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"

namespace volumen {

namespace {

View* makeVolumeView(const ViewParts& parts, ViewId id, QWidget* parent) {
  return new VolumeView(parts.session, parts.drawService, id, parent);
}

template <class V>
View* makeFlatView(const ViewParts& parts, ViewId id, QWidget* parent) {
  return new V(parts, id, parent);
}

struct Maker {
  ViewFamily family;
  View* (*make)(const ViewParts& parts, ViewId id, QWidget* parent);
};
constexpr Maker makers[] = {{ViewFamily::scene, makeVolumeView},
                            {ViewFamily::slices, makeFlatView<SliceView>},
                            {ViewFamily::frames, makeFlatView<FrameView>}};

}  // namespace

View* makeView(ViewFamily family, const ViewParts& parts, ViewId id, QWidget* parent) {
  View* view = std::ranges::find(makers, family, &Maker::family)->make(parts, id, parent);
  view->hide();
  return view;
}

}  // namespace volumen
