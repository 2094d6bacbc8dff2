#include "ui/views/view_makers.h"

#include <algorithm>
#include <utility>

#include "ui/views/frame_view.h"
#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"

namespace volumen {

namespace {

View* makeVolumeView(const ViewParts& parts, ViewId id, QWidget* parent) {
  return new VolumeView(parts.session, parts.drawn, parts.drawService, parts.segments, id, parent);
}

template <class V>
View* makeFlatView(const ViewParts& parts, ViewId id, QWidget* parent) {
  return new V(parts, id, parent);
}

using Make = View* (*)(const ViewParts& parts, ViewId id, QWidget* parent);

constexpr std::pair<ViewFamily, Make> makers[] = {
    {ViewFamily::scene, makeVolumeView},
    {ViewFamily::slices, makeFlatView<SliceView>},
    {ViewFamily::frames, makeFlatView<FrameView>},
};

}  // namespace

View* makeView(ViewFamily family, const ViewParts& parts, ViewId id, QWidget* parent) {
  View* view =
      std::ranges::find(makers, family, &std::pair<ViewFamily, Make>::first)->second(parts, id, parent);
  view->hide();
  return view;
}

}  // namespace volumen
