#pragma once

#include "ui/controller/screen_picture.h"

namespace volumen {

/// Draws one volume for one view, with caches and time measurements. For the render thread only.
class ViewDrawing {
 public:
  /// `shownAt` is the number of the call that showed this volume in the view.
  ViewDrawing(VolumePtr volume, int shownAt, Draw draw)
      : volume_(std::move(volume)), shownAt_(shownAt), draw_(std::move(draw)) {}

  const VolumePtr& volume() const { return volume_; }
  int shownAt() const { return shownAt_; }
  const Draw& draw() const { return draw_; }

  /// Returns the pass of a draft, never finer than the picture at rest.
  Pass draftPass(PictureLevel rest) const;
  /// Returns the factor of a second draft before a slow picture at rest.
  std::optional<double> factorOfFiner(PictureLevel rest) const {
    if (rest.quality == Quality::draft) return {};
    return cost_.factorOfFiner(drafted_, rest.edge);
  }
  /// Returns whether the same scene is on screen at the same size, at least as a draft.
  bool isSeen(const ScreenRequest& request) const {
    return seen_ && seen_->scene == request.scene && seen_->pixels == request.pixels;
  }
  /// Records the time of a picture of the request.
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
