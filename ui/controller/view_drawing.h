#pragma once

#include "ui/controller/screen_picture.h"

namespace volumen {

/// One view of one volume: what draws it, with its caches, and what that takes. On the render thread only.
class ViewDrawing {
 public:
  /// `shownAt`: a number of the showing of this volume in the view.
  ViewDrawing(VolumePtr volume, int shownAt, Draw draw)
      : volume_(std::move(volume)), shownAt_(shownAt), draw_(std::move(draw)) {}

  const VolumePtr& volume() const { return volume_; }
  int shownAt() const { return shownAt_; }
  const Draw& draw() const { return draw_; }

  /// A draft, but never finer than the picture at rest.
  Pass draftPass(PictureLevel rest) const;
  /// The factor of a first picture between that draft and the picture at rest, where that takes long.
  std::optional<double> factorOfFirst(PictureLevel rest) const {
    return cost_.factorOfFirst(drafted_, rest.edge);
  }
  /// Whether the same scene is on screen in as many pixels, if only as a draft.
  bool isSeen(const ScreenRequest& request) const {
    return seen_ && seen_->scene == request.scene && seen_->pixels == request.pixels;
  }
  /// A picture of the request was drawn: learns from its time.
  void drew(const ScreenPicture& picture, const ScreenRequest& request);

 private:
  VolumePtr volume_;
  int shownAt_;
  Draw draw_;
  DraftPace pace_;
  RestCost cost_;
  double drafted_ = 1;  // factor of the last draft
  std::optional<ScreenRequest> seen_;
};

}  // namespace volumen
