#include "app/exports/chosen_pictures.h"
#include "app/exports/exports.h"
#include "app/exports/image_list.h"
#include "app/measured_shapes.h"
#include "app/plane_options.h"
#include "io/export/presentation_state.h"
#include "results/numbers/shapes_presentation.h"
#include "results/numbers/shapes_report.h"

namespace volumen {

namespace {

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

Status addShapes(const ExportJob& job, const Study& study, const std::vector<Shape>& shapes,
                 const ChosenPictures& chosen, PictureGreys& shown, Exported& exported,
                 const CancelToken& cancel) {
  if (Status s = checkPlaces(job, shapes, chosen); !s) return s;
  const auto sources = openForShapes(study, job.path, chosen.series.id, shapes, false, {}, cancel);
  if (!sources) return sources.error();
  if (sources->volume) {
    addUnread(exported.unread, sources->volume->loaded.unread);
    exported.notes.insert(exported.notes.end(), sources->volume->notes.begin(), sources->volume->notes.end());
  }
  const ShapesVolume volume = volumeOf(*sources);
  if (Status s = drawShapes(shapesToMeasure(shapes, volume), chosen, shown, cancel); !s)
    return Error{job.shapes + ": " + s.message()};
  if (shown.presentation.annotations.empty() && job.window.empty())
    return Error{job.shapes + ": No shape in it can be drawn on the pictures of " + chosen.series.id + "."};
  return checkLosses(job.path, exported.unread);
}

}  // namespace

Status checkPresentation(const ExportJob& job) {
  if (job.window.empty() && job.shapes.empty()) return Error{"--as gsps needs --window C,W or --roi FILE."};
  if (const auto window = windowOf(job.window); !window) return window.error();
  const auto images = imagesIn(job.images);
  return images ? Status() : images.error();
}

Result<Exported> exportPresentation(const ExportJob& job, const CancelToken& cancel) {
  const auto window = windowOf(job.window);
  if (!window) return window.error();
  const auto shapes = readShapes(job.shapes);
  if (!shapes) return shapes.error();
  const auto images = imagesIn(job.images);
  if (!images) return images.error();
  const Result<Study> study = openStudyAt(job.path, cancel);
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
  shown->presentation.label = "WINDOW";
  if (!shapes->empty())
    if (Status s = addShapes(job, *study, *shapes, *chosen, *shown, exported, cancel); !s) return s.error();
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
