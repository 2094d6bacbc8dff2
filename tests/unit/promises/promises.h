#pragma once

#include <QString>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/fixtures/picture_words.h"
#include "viewer/render/render.h"

namespace volumen::tests {

/// What a level promises on well-conditioned pixels (design.md 2), in 1/255.
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

/// Whether to print what each row measured.
inline bool figuresWanted() { return qEnvironmentVariableIsSet("VOLUMEN_FIGURES"); }

/// A way to draw. Not every one keeps the levels' promises: what voxels are shaded before they are
/// interpolated (preshaded) is another picture, which only agrees where matter is the same everywhere.
struct DrawWay {
  const char* name;
  RenderOptions options;
  bool promised;
  bool slow = false;  ///< where OpenGL is a processor: by seconds a picture

  bool usesOpenGl() const;
  /// Whether it may refuse what others draw: OpenGL's textures have a largest edge (on no machine below
  /// 2048), shaded voxels no value left to project.
  bool mayRefuse(const Scene& scene, const Volume& volume) const;
};
/// All of them; those that need OpenGL only where it can be had.
std::vector<DrawWay> drawWays();
/// Those that keep the promises and are quick.
std::vector<DrawWay> promisedWays();

/// A scene and the truth about it, each part found when it is first asked for.
class Truth {
 public:
  /// `caches` must outlive it.
  Truth(RenderCaches& caches, Scene scene, glm::ivec2 size);

  /// Draws it; throws where the plan or the renderer refuses.
  Rendered rendered(RenderOptions options);
  Picture drawn(RenderOptions options) { return rendered(options).picture; }
  /// The error on every pixel where that keeps `promise` (it then needs no knowing which are the few
  /// ill-conditioned ones), else on the well-conditioned ones.
  PictureError errorOf(const Picture& picture, const Promise& promise);
  PictureError errorOf(const Picture& picture);  ///< on the well-conditioned pixels
  /// The error of every pixel (the largest over RGBA, /255), 0 at ill-conditioned ones.
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
