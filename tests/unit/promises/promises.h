#pragma once

#include <QString>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/fixtures/picture_words.h"
#include "viewer/render/render.h"

namespace volumen::tests {

/// A level's promise on well-conditioned pixels (design.md 2), in 1/255.
struct Promise {
  const char* name;
  Quality quality;
  double leastPsnrDb, most99, mostMaximum;

  bool keptBy(const PictureError& e) const {
    return e.psnrDb >= leastPsnrDb && e.percentile99 <= most99 && e.maximum <= mostMaximum;
  }
};
constexpr Promise promiseAt(Quality quality) {
  const LevelPromise& p = promiseOf(quality);
  return {qualityName(quality), quality, p.leastPsnrDb, p.most99, p.mostMaximum};
}
inline constexpr Promise promises[] = {promiseAt(Quality::standard), promiseAt(Quality::high),
                                       promiseAt(Quality::exact)};

/// How far a draft is from `standard`, in 1/255 (design.md 2): the RMSE of means over blocks, and the largest
/// component of the mean difference. Only whole blocks count.
struct DraftError {
  double rmseOfBlocks = 0, meanColour = 0;

  bool keepsPromise() const {
    return rmseOfBlocks <= draftPromise.mostRmse && meanColour <= draftPromise.mostMeanColour;
  }
};
DraftError draftErrorOf(const Picture& draft, const Picture& standard);
QString inWords(const DraftError& e);

inline RenderOptions atLevel(Quality quality) {
  RenderOptions options;
  options.quality = quality;
  return options;
}
inline RenderOptions atStep(double stepVoxels) {
  RenderOptions options;
  options.step = stepVoxels;
  return options;
}

/// Returns whether each row prints its measured figures.
inline bool figuresWanted() { return qEnvironmentVariableIsSet("VOLUMEN_FIGURES"); }

/// A way to draw. Not every way keeps the levels' promises. Shading voxels before interpolation (preshaded)
/// gives another picture, which only agrees where matter is homogeneous.
struct DrawWay {
  const char* name;
  RenderOptions options;
  bool promised;
  bool slow = false;  ///< true if OpenGL runs on a processor and takes seconds a picture

  bool usesOpenGl() const;
  /// Returns whether this way may refuse a scene that others draw. OpenGL's textures have a largest edge
  /// (never below 2048). Shaded voxels have no value left to project.
  bool mayRefuse(const Scene& scene, const Volume& volume) const;
};
/// Returns all ways. Those with OpenGL are included only if it is available.
std::vector<DrawWay> drawWays();
/// Returns the quick ways that keep the promises.
std::vector<DrawWay> promisedWays();

/// A scene and its true picture, each part computed on first use.
class Truth {
 public:
  /// `caches` must outlive this object.
  Truth(RenderCaches& caches, Scene scene, glm::ivec2 size);

  /// Draws the scene. Throws if the plan or the renderer refuses it.
  Rendered rendered(RenderOptions options);
  Picture drawn(RenderOptions options) { return rendered(options).picture; }
  /// Returns the error over all pixels if that keeps `promise`, which avoids finding the few ill-conditioned
  /// pixels. Else returns the error over well-conditioned pixels.
  PictureError errorOf(const Picture& picture, const Promise& promise);
  PictureError errorOf(const Picture& picture);  ///< on the well-conditioned pixels
  /// Returns the error of every pixel (the largest over RGBA, in /255); 0 at ill-conditioned ones.
  std::vector<double> errorOfPixels(const Picture& picture);
  double illConditionedShare();
  const Picture& reference();

 private:
  const std::vector<std::uint8_t>& use();

  RenderCaches& caches_;
  Scene scene_;
  glm::ivec2 size_;
  std::optional<Scene> complete_;
  std::optional<Picture> reference_;
  std::optional<std::vector<std::uint8_t>> use_;
};

}  // namespace volumen::tests
