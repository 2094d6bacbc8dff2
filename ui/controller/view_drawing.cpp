#include "ui/controller/view_drawing.h"

#include <algorithm>

namespace volumen {

Pass ViewDrawing::draftPass(PictureLevel rest) const {
  const double factor = pace_.factor();
  if (rest.quality == Quality::draft && rest.edge >= factor) return restPass(rest);
  return {factor > 1 ? Quality::draft : Quality::standard, factor};
}

void ViewDrawing::drew(const ScreenPicture& picture, const ScreenRequest& request) {
  // Work done once per volume says nothing about the next picture, and full pictures at rest say nothing
  // about drafts.
  const double ms = std::max(0.0, picture.ms - picture.stats.gradientsMs);
  const Pass pass{picture.quality, picture.factor, picture.step};
  if (pass == draftPass(request.level) && pass.factor == pace_.factor()) pace_.measured(ms);
  if (pass.step)
    cost_.firstTook(ms, pass.factor);
  else if (pass.quality == Quality::draft && !picture.atRest)
    cost_.draftTook(ms, pass.factor);
  if (picture.atRest) cost_.restTook(ms, request.level.edge);
  drafted_ = pass.factor;
  seen_ = request;
}

}  // namespace volumen
