#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace volumen {

/// Orientation of an image on screen (PS3.3 C.10.6): rotated clockwise, then mirrored left to right.
struct PictureTurn {
  int quarters = 0;  ///< Clockwise quarter turns, 0 .. 3
  bool mirrored = false;
  bool operator==(const PictureTurn&) const = default;
};

/// Returns the turn equal to `first` followed by `second`.
PictureTurn composed(PictureTurn first, PictureTurn second);

/// Updates the right and down directions of an image for a turn.
void turnAxes(PictureTurn turn, glm::dvec3& right, glm::dvec3& down);

/// A pixel rectangle, both corners inclusive, counted from 0; it may reach beyond the image.
struct PixelBox {
  glm::ivec2 from{0}, to{0};
  bool operator==(const PixelBox&) const = default;
};

/// Units of annotation positions (PS3.3 C.10.5).
enum class AnnotationUnits {
  /// Pixels of the image before it is turned: 0, 0 is the outer corner of the first pixel and 0.5, 0.5 its
  /// centre; columns, rows is the outer corner of the last.
  pixel,
  display  ///< Fractions of the displayed, turned area: 0, 0 is top left, 1, 1 bottom right
};

enum class GraphicType {
  point,         ///< 1 point
  polyline,      ///< Connected points; closed if the last equals the first
  interpolated,  ///< A smooth curve through the points
  circle,        ///< Centre and a point on the circle
  ellipse        ///< Ends of the major axis, then of the minor one
};

/// A graphic object of a presentation state, with as many points as its type needs.
struct Graphic {
  GraphicType type = GraphicType::polyline;
  AnnotationUnits units = AnnotationUnits::pixel;
  std::vector<glm::dvec2> points;
  bool filled = false;
  std::string layer;
};

/// A text object: in a box, at an anchor point, or both.
struct GraphicText {
  struct Box {
    glm::dvec2 topLeft{0}, bottomRight{0};
    AnnotationUnits units = AnnotationUnits::pixel;
    enum class Justified { left, centre, right } justified = Justified::left;
  };
  struct Anchor {
    glm::dvec2 point{0};
    AnnotationUnits units = AnnotationUnits::pixel;
    bool visible = true;  ///< True if a line to the point is drawn
  };
  std::string text;  ///< UTF-8, may have several lines
  std::optional<Box> box;
  std::optional<Anchor> anchor;
  std::string layer;
};

/// A layer of graphics and texts.
struct GraphicLayer {
  std::string name, description;
  double order = 0;                   ///< The lowest is drawn first
  float grey = 1;                     ///< Recommended grey, 0 black .. 1 white; 1 if not stated
  std::optional<glm::u8vec3> colour;  ///< Recommended colour, sRGB
};

/// Presentation of one frame, apart from greys and shutter.
struct FramePresentation {
  PictureTurn turn;
  std::optional<PixelBox> area;      ///< Displayed area; empty if all
  std::vector<GraphicLayer> layers;  ///< Lowest first
  std::vector<Graphic> graphics;
  std::vector<GraphicText> texts;
};

/// Maps the pixels of the displayed, turned image to those of the acquired one.
class PresentedGrid {
 public:
  /// `size` is that of the acquired image.
  PresentedGrid(const FramePresentation& how, glm::ivec2 size);

  /// Returns the size of the displayed image; each side is at least 1 and below 2^31.
  glm::ivec2 size() const { return size_; }
  /// Returns the image pixel that displayed pixel `p` (from 0) shows; it may lie outside the image.
  glm::ivec2 pixelAt(glm::ivec2 p) const;
  /// Returns an annotation position in pixels of the displayed image, with its outer corner at 0, 0.
  glm::dvec2 displayed(glm::dvec2 position, AnnotationUnits units) const;

 private:
  PixelBox area_;
  PictureTurn turn_;
  glm::ivec2 size_;
};

/// Returns the displayed pixels, `channels` values each; pixels outside the image are `outside`.
template <class T>
std::vector<T> presentPixels(const PresentedGrid& grid, const std::vector<T>& pixels, glm::ivec2 size,
                             int channels, T outside) {
  std::vector<T> shown;
  const auto width = std::size_t(channels);
  shown.reserve(std::size_t(grid.size().x) * std::size_t(grid.size().y) * width);
  for (int y = 0; y < grid.size().y; ++y)
    for (int x = 0; x < grid.size().x; ++x) {
      const glm::ivec2 p = grid.pixelAt({x, y});
      const bool inside = p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y;
      const std::size_t n = inside ? (std::size_t(p.y) * std::size_t(size.x) + std::size_t(p.x)) * width : 0;
      for (std::size_t c = 0; c < width; ++c) shown.push_back(inside ? pixels[n + c] : outside);
    }
  return shown;
}

/// Returns a graphic as a polyline in its own units; closed ones repeat the first point. Curves are cut into
/// pieces below 1/100 of a turn, or 16 between two points.
std::vector<glm::dvec2> outlineOf(const Graphic& graphic);

}  // namespace volumen
