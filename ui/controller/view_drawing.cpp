#include "ui/controller/view_drawing.h"

#include <algorithm>

namespace volumen {

Pass ViewDrawing::draftPass(PictureLevel rest) const {
  const double factor = pace_.factor();
  if (rest.quality == Quality::draft && rest.edge >= factor) return restPass(rest);
  return {Quality::draft, factor};
}

void ViewDrawing::drew(const ScreenPicture& picture, const ScreenRequest& request) {
  // Work done once per volume says nothing about the next picture, and full pictures at rest say nothing
  // about drafts.
  const double ms = std::max(0.0, picture.ms - picture.stats.gradientsMs);
  if (picture.quality == Quality::draft) {
    if (picture.factor == pace_.factor()) pace_.measured(ms);
    cost_.draftTook(ms, picture.factor);
  } else if (picture.atRest)
    cost_.restTook(ms, request.level.edge);
  drafted_ = picture.factor;
  seen_ = request;
}

}  // namespace volumen
