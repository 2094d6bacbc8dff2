#pragma once

#include "viewer/evaluation/progress.h"
#include "viewer/plan/plan.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// The reference of a picture, at every pixel, or, where the picture is large, at one pixel of each cell of a
/// grid laid over it: the reference casts its rays one by one, some thousand times slower than the others.
struct Truth {
  glm::ivec2 size{0};              ///< of the picture
  glm::ivec2 grid{0};              ///< cells; `size` where every pixel is taken
  std::vector<glm::ivec2> pixels;  ///< one a cell, row by row
  Picture picture;                 ///< of the grid's size: the reference at these pixels
  std::vector<std::uint8_t> well;  ///< which of them are well-conditioned (design.md 2)
  double ms = 0;                   ///< that it took

  /// Of `pixels`, how many are not well-conditioned and therefore not counted.
  std::size_t illConditioned() const;
};

/// One pixel of each cell of a grid of at most `most` cells, of the picture's proportions: at a place in the
/// cell that only the cell decides, so that no pattern of the scene meets one of the pixels.
void choosePixels(Truth& truth, glm::ivec2 size, int most);

/// The reference of a complete scene (a plan's). An Error only where cancelled.
Result<Truth> makeTruth(const Scene& complete, const Volume& volume, glm::ivec2 size, int mostPixels,
                        int threads, const StudyProgress& progress = {}, const CancelToken& cancel = {});

/// The truth's pixels as `picture` has them. A picture of another size shows the same view: it is read
/// bilinearly at their places.
Picture atPixelsOf(const Truth& truth, const Picture& picture);

}  // namespace volumen
