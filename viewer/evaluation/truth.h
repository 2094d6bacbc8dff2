#pragma once

#include "viewer/evaluation/progress.h"
#include "viewer/plan/plan.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// The reference of a picture at every pixel, or for large pictures at one pixel of each cell of a grid. The
/// reference casts rays one by one and is some thousand times slower than the other methods.
struct Truth {
  glm::ivec2 size{0};              ///< Size of the picture.
  glm::ivec2 grid{0};              ///< Size of the grid in cells; equals `size` if every pixel is used.
  std::vector<glm::ivec2> pixels;  ///< One pixel per cell, row by row.
  Picture picture;                 ///< The reference at these pixels, in the grid's size.
  std::vector<std::uint8_t> well;  ///< Non-zero for well-conditioned pixels (design.md 2).
  double ms = 0;                   ///< Time taken.

  /// Returns how many of `pixels` are ill-conditioned and therefore not counted.
  std::size_t illConditioned() const;
};

/// Chooses one pixel of each cell of a grid of at most `most` cells with the picture's proportions. Its
/// position depends only on the cell, pseudo-randomly, so that no pattern of the scene coincides with the
/// pixels.
void choosePixels(Truth& truth, glm::ivec2 size, int most);

/// Computes the reference of a complete scene, as plans hold it. Returns an Error only if cancelled.
Result<Truth> makeTruth(const Scene& complete, const Volume& volume, glm::ivec2 size, int mostPixels,
                        int threads, const StudyProgress& progress = {}, const CancelToken& cancel = {});

/// Returns the truth's pixels as `picture` shows them. A picture of another size must show the same view and
/// is sampled bilinearly.
Picture atPixelsOf(const Truth& truth, const Picture& picture);

}  // namespace volumen
