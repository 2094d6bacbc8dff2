#include "app/exports/chosen_pictures.h"
#include "app/exports/exports.h"
#include "app/exports/image_list.h"
#include "app/exports/picture_greys.h"
#include "app/measured_shapes.h"
#include "app/plane_options.h"
#include "io/export/presentation_state.h"
#include "io/paths/open_path.h"
#include "results/numbers/annotation_of_shape.h"
#include "results/numbers/shapes_report.h"
#include "results/series/loaded_frame.h"
#include "results/text/measured_text.h"
#include "results/text/text.h"

namespace volumen {

namespace {

constexpr const char* shapesLayer = "MEASUREMENTS";

// Returns the name of a shape, and its number below.
std::string wordsOf(const Shape& shape, const std::optional<Measured>& measured) {
  QStringList lines;
  if (!shape.name.empty()) lines << shownText(shape.name);
  if (measured) lines << measuredLines(shape, *measured);
  return lines.join(QStringLiteral("\r\n")).toStdString();
}

/// Measures shapes and draws them on the pictures that they lie on.
class ShapesToGraphics {
 public:
  ShapesToGraphics(const ExportJob& job, const std::vector<Shape>& shapes, const ChosenPictures& chosen,
                   const ShapeSources& sources, const CancelToken& cancel)
      : job_(job), shapes_(shapes), chosen_(chosen), sources_(sources), cancel_(cancel) {}

  // Adds all to a presentation, whose pictures have pixels of this size. The Error names a shape.
  Status run(glm::dvec2 pixelMm, PictureGreys& shown) {
    if (sources_.volume) {
      const auto scale = scaleFor(sources_.volume->series, {});
      if (!scale) return scale.error();
      scale_ = *scale;
    }
    for (std::size_t n = 0; n < shapes_.size() && !cancel_.cancelled(); ++n)
      if (Status s = add(n, pixelMm, shown); !s)
        return Error{job_.shapes + ": " + shapeWords(shapes_, n) + ": " + s.message()};
    if (!shown.presentation.annotations.empty())
      shown.presentation.layers.push_back({.name = shapesLayer, .description = "Measurements", .colour = {}});
    return {};
  }

 private:
  Status add(std::size_t n, glm::dvec2 pixelMm, PictureGreys& shown) {
    const Shape& shape = shapes_[n];
    const auto leaveOut = [&](const char* why) {
      shown.notes.push_back(shapeWords(shapes_, n) + " " + why + " and is left out.");
      return Status();
    };
    const auto frame = shape.frame ? frameMeant(chosen_.series, *shape.frame) : std::nullopt;
    if (shape.frame && !frame) return leaveOut("is on none of the pictures");
    std::optional<Measured> measured;
    if (!ruleOf(shape.kind).numberless) {
      auto found = measuredShape(shape, sources_, scale_, {}, cancel_).measured;
      if (!found) return found.error();
      measured = *std::move(found);
    }
    const auto drawn = annotationOf(shape, placeOf(frame, pixelMm), wordsOf(shape, measured), shapesLayer);
    if (!drawn) return leaveOut("does not lie within one slice as acquired");
    const ReferencedPicture& picture = drawn->picture;
    if (!namesFrame(shown.presentation.pictures, picture.sopInstanceUid, picture.frames[0]))
      return leaveOut("is on none of the pictures");
    if (drawn->graphics.empty() && !drawn->text) return leaveOut("has no text");
    Presentation::Annotations part{{picture}, drawn->graphics, {}};
    if (drawn->text) part.texts.push_back(*drawn->text);
    shown.presentation.annotations.push_back(std::move(part));
    return {};
  }

  MeasuredOn placeOf(std::optional<int> frame, glm::dvec2 pixelMm) const {
    if (frame) return {&chosen_.series, {}, {}, {}, false, *frame, pixelMm};
    const Loaded& loaded = sources_.volume->loaded;
    return {&chosen_.series, loaded.drawn->geometry(), loaded.origins, loaded.places};
  }

  const ExportJob& job_;
  const std::vector<Shape>& shapes_;
  const ChosenPictures& chosen_;
  const ShapeSources& sources_;
  const CancelToken& cancel_;
  ValueScale scale_;
};

// Returns the instance of the first shape if all are on frames: they tell what series is meant.
std::string instanceOf(const std::vector<Shape>& shapes) {
  const bool areOnFrames =
      std::ranges::all_of(shapes, [](const Shape& shape) { return shape.frame.has_value(); });
  return areOnFrames && !shapes.empty() ? shapes.front().frame->instance : std::string();
}

// The Error names a shape in the patient, where pictures without a place are not.
Status checkPlaces(const ExportJob& job, const std::vector<Shape>& shapes, const ChosenPictures& chosen) {
  for (std::size_t n = 0; n < shapes.size() && !chosen.hasPlace; ++n)
    if (!shapes[n].frame)
      return Error{job.shapes + ": " + shapeWords(shapes, n) + ": it lies in a volume, and " +
                   chosen.series.id + " is none: choose one with --series."};
  return {};
}

Status addShapes(const ExportJob& job, const std::vector<Shape>& shapes, const ChosenPictures& chosen,
                 PictureGreys& shown, Exported& exported, const CancelToken& cancel) {
  if (Status s = checkPlaces(job, shapes, chosen); !s) return s;
  const auto sources = openForShapes(job.path, chosen.series.id, shapes, false, {}, cancel);
  if (!sources) return sources.error();
  if (sources->volume) {
    addUnread(exported.unread, sources->volume->loaded.unread);
    exported.notes.insert(exported.notes.end(), sources->volume->notes.begin(), sources->volume->notes.end());
  }
  const glm::dvec2 pixelMm = shown.first.pixel.mm;
  if (Status s = ShapesToGraphics(job, shapes, chosen, *sources, cancel).run(pixelMm, shown); !s) return s;
  if (shown.presentation.annotations.empty() && job.window.empty())
    return Error{job.shapes + ": No shape in it can be drawn on the pictures of " + chosen.series.id + "."};
  return checkLosses(job.path, exported.unread);
}

}  // namespace

Status checkPresentation(const ExportJob& job) {
  if (job.window.empty() && job.shapes.empty()) return Error{"--as gsps needs --window C,W or --roi FILE."};
  const auto window = windowOf(job.window);
  return window ? Status() : window.error();
}

Result<Exported> exportPresentation(const ExportJob& job, const CancelToken& cancel) {
  const auto window = windowOf(job.window);
  if (!window) return window.error();
  const auto shapes = readShapes(job.shapes);
  if (!shapes) return shapes.error();
  const auto images = imagesIn(job.images);
  if (!images) return images.error();
  const Result<Study> study = openPath(job.path, {}, cancel);
  if (!study) return study.error();
  const auto chosen = choosePictures(job.path, *study, job.series, *images, instanceOf(*shapes));
  if (!chosen) return chosen.error();
  const Series& series = chosen->series;
  const auto mosaic = isMosaic(*study, series);
  if (!mosaic) return mosaic.error();
  if (*mosaic)
    return Error{
        series.id +
        " is a mosaic, whose slices are tiles of one image: a presentation state shows it as a whole."};
  Exported exported{chosen->notes, series.unread};
  if (Status s = checkLosses(job.path, exported.unread); !s) return s.error();
  auto shown = greysOfPictures(*chosen, *window, cancel);
  if (!shown) return shown.error();
  shown->presentation.label = shapes->empty() ? "WINDOW" : shapesLayer;
  if (!shapes->empty())
    if (Status s = addShapes(job, *shapes, *chosen, *shown, exported, cancel); !s) return s.error();
  ObjectTags tags;
  tags.description = "Presentation state";
  tags.seriesNumber = nextSeriesNumber(*study, series.studyUid);
  const auto notes =
      writePresentationState(shown->presentation, series, shown->first, tags, job.output, {}, cancel);
  if (!notes) return notes.error();
  exported.notes.insert(exported.notes.end(), shown->notes.begin(), shown->notes.end());
  exported.notes.insert(exported.notes.end(), notes->begin(), notes->end());
  return exported;
}

}  // namespace volumen
