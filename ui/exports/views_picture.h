#pragma once

#include "ui/exports/picture_maker.h"

namespace volumen {

class Session;
class View;

/// Makes a picture of views as they are on screen now. It is captured by `capture` as soon as all `views`
/// show the present workspace (View::hasItsPicture). If the workspace or the preferences change before, there
/// is an Error instead.
PictureMakerPtr viewsPicture(const std::vector<View*>& views, const Session& session,
                             const std::function<MadePicture()>& capture);

}  // namespace volumen
