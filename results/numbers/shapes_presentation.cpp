#include "results/numbers/shapes_presentation.h"

#include "results/numbers/annotation_of_shape.h"
#include "results/series/loaded_frame.h"
#include "results/text/measured_text.h"
#include "results/text/text.h"

namespace volumen {

namespace {

constexpr const char* shapesLayer = "MEASUREMENTS";

// Returns the text of a shape: its name, and its measured numbers on the lines below.
std::string wordsOf(const Shape& shape, const std::optional<Measured>& measured) {
  QStringList lines;
  if (const QString name = shownText(shape.name); !name.isEmpty()) lines << name;
  if (measured) lines << measuredLines(shape, *measured);
  return lines.join(QStringLiteral("\r\n")).toStdString();
}

// Returns the images that a shape is on; empty if it is on a frame of another series.
std::optional<MeasuredOn> placeOf(const ShapeToMeasure& one, const SeriesPictures& pictures,
                                  glm::dvec2 pixelMm) {
  if (!one.shape.frame) return placeIn(*one.volume);
  const auto frame = frameMeant(pictures.series, *one.shape.frame);
  if (!frame) return {};
  return MeasuredOn{&pictures.series, {}, {}, {}, false, *frame, pixelMm};
}

// Adds a shape to `shown`. If it must be left out, sets `why` to the reason.
Status draw(const ShapeToMeasure& one, const Result<Measured>& found, const SeriesPictures& pictures,
            Presentation& shown, glm::dvec2 pixelMm, const char*& why) {
  why = "is on none of the pictures";
  const auto place = placeOf(one, pictures, pixelMm);
  if (!place) return {};
  std::optional<Measured> measured;
  if (!ruleOf(one.shape.kind).numberless) {
    if (!found) return found.error();
    measured = *found;
  }
  const auto drawn = annotationOf(one.shape, *place, wordsOf(one.shape, measured), shapesLayer);
  if (!drawn) return why = "does not lie within one slice as acquired", Status();
  const ReferencedPicture& picture = drawn->picture;
  if (!namesFrame(shown.pictures, picture.sopInstanceUid, picture.frames[0])) return {};
  if (drawn->graphics.empty() && !drawn->text) return why = "has no text", Status();
  Presentation::Annotations part{{picture}, drawn->graphics, {}};
  if (drawn->text) part.texts.push_back(*drawn->text);
  shown.annotations.push_back(std::move(part));
  why = nullptr;
  return {};
}

}  // namespace

Status drawShapes(std::span<const ShapeToMeasure> shapes, const SeriesPictures& pictures, PictureGreys& shown,
                  const CancelToken& cancel) {
  Presentation& p = shown.presentation;
  FramesToMeasure frames({pictures.series});
  const auto measured = measuredShapes(shapes, frames, cancel);
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    const ShapeToMeasure& one = shapes[n];
    const char* why = nullptr;
    if (Status s = draw(one, measured[n].measured, pictures, p, shown.first.pixel.mm, why); !s)
      return Error{one.name + ": " + s.message()};
    if (why) shown.notes.push_back(one.name + " " + why + " and is left out.");
  }
  p.label = shapesLayer;
  if (!p.annotations.empty())
    p.layers.push_back({.name = shapesLayer, .description = "Measurements", .colour = {}});
  return {};
}

}  // namespace volumen
