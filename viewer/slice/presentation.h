#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace volumen {

/// How a picture is turned on screen (PS3.3 C.10.6): first clockwise, then mirrored left to right.
struct PictureTurn {
  int quarters = 0;  ///< of a turn clockwise, 0 .. 3
  bool mirrored = false;
  bool operator==(const PictureTurn&) const = default;
};

/// One turn that does what these two do one after the other.
PictureTurn composed(PictureTurn first, PictureTurn second);

/// The directions of a picture's right and down once it is turned.
void turnAxes(PictureTurn turn, glm::dvec3& right, glm::dvec3& down);

/// A rectangle of pixels, both ends inside, counted from 0; it may reach beyond the picture.
struct PixelBox {
  glm::ivec2 from{0}, to{0};
  bool operator==(const PixelBox&) const = default;
};

/// What positions of annotations count in (PS3.3 C.10.5).
enum class AnnotationUnits {
  pixel,   ///< pixels of the picture before it is turned: 0, 0 is the outer corner of the first pixel, its
           ///< centre 0.5, 0.5; columns, rows is the outer corner of the last
  display  ///< parts of what is displayed after it is turned: 0, 0 its top left, 1, 1 its bottom right corner
};

enum class GraphicType {
  point,         ///< 1 point
  polyline,      ///< points, each joined to the next; closed where the last is the first
  interpolated,  ///< a smooth curve through the points
  circle,        ///< its centre and a point on it
  ellipse        ///< the ends of the major axis, then of the minor one
};

/// A graphic object of a presentation state. Always as many points as its type needs.
struct Graphic {
  GraphicType type = GraphicType::polyline;
  AnnotationUnits units = AnnotationUnits::pixel;
  std::vector<glm::dvec2> points;
  bool filled = false;
  std::string layer;
};

/// A text object: it stands in a box, at a point, or in a box and tells of a point.
struct GraphicText {
  struct Box {
    glm::dvec2 topLeft{0}, bottomRight{0};
    AnnotationUnits units = AnnotationUnits::pixel;
    enum class Justified { left, centre, right } justified = Justified::left;
  };
  struct Anchor {
    glm::dvec2 point{0};
    AnnotationUnits units = AnnotationUnits::pixel;
    bool visible = true;  ///< a line to it is wanted
  };
  std::string text;  ///< UTF-8, may have several lines
  std::optional<Box> box;
  std::optional<Anchor> anchor;
  std::string layer;
};

/// A layer that graphics and texts lie on.
struct GraphicLayer {
  std::string name, description;
  double order = 0;                   ///< the lowest is drawn first
  float grey = 1;                     ///< recommended, 0 black .. 1 white; 1 where it is not said
  std::optional<glm::u8vec3> colour;  ///< recommended, sRGB
};

/// How one frame is to be shown beside its greys and its shutter.
struct FramePresentation {
  PictureTurn turn;
  std::optional<PixelBox> area;      ///< what is displayed; none: all of it
  std::vector<GraphicLayer> layers;  ///< the lowest first
  std::vector<Graphic> graphics;
  std::vector<GraphicText> texts;
};

/// From the pixels of a picture to those of the displayed, turned picture, pixel for pixel.
class PresentedGrid {
 public:
  /// `size`: of the picture as acquired.
  PresentedGrid(const FramePresentation& how, glm::ivec2 size);

  /// Of the displayed picture; each at least 1 and below 2^31.
  glm::ivec2 size() const { return size_; }
  /// The pixel of the picture that displayed pixel `p` (from 0) shows; it may lie outside the picture.
  glm::ivec2 pixelAt(glm::ivec2 p) const;
  /// Where a position of an annotation lies in the displayed picture, in its pixels, outer corner 0, 0.
  glm::dvec2 displayed(glm::dvec2 position, AnnotationUnits units) const;

 private:
  PixelBox area_;
  PictureTurn turn_;
  glm::ivec2 size_;
};

/// The pixels that are displayed, `channels` values each; `outside` where they lie outside the picture.
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

/// A graphic as a line through points of its own units, closed ones with the first point again at the end.
/// Curves are cut into pieces short of 1/100 of a turn, and 16 between two points.
std::vector<glm::dvec2> outlineOf(const Graphic& graphic);

}  // namespace volumen
