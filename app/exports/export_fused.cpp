#include "app/exports/export_fused.h"

#include "app/progress.h"
#include "app/slice_picture.h"
#include "io/export/captured_pictures.h"
#include "io/export/colour_series.h"
#include "io/study/faces.h"

namespace volumen {

namespace {

// Returns the slices with their sources in both series.
Result<ColourSlices> colourSlicesOf(const SliceStack& stack, const Opened& under, const Overlay& overlay,
                                    const CancelToken& cancel) {
  const Series& over = overlay.opened.series;
  DicomSource ofOver;
  if (over.format == "DICOM") {
    auto read = readDicomSource(over, {}, cancel);
    if (!read) return read.error();
    ofOver = *std::move(read);
  }
  ColourSlices slices{
      geometryOf(stack), stack.first.slabMm > 0 ? stack.first.slabMm : stack.distanceMm, {}, {}};
  slices.geometry.calibrated = under.loaded.drawn->geometry().calibrated;
  for (int n = 0; n < stack.count; ++n) {
    slices.sources.push_back(sourcesOf(stack.plane(n), under.loaded));
    const SlicePlane moved = planeMovedBy(stack.plane(n), overlay.layer.fromPlane);
    slices.overlaid.push_back(picturesOf(ofOver, sourcesOf(moved, overlay.opened.loaded)));
  }
  return slices;
}

CaptureTags fusedTags(const SliceStack& stack, const SeriesSource& source, const Overlay& overlay,
                      const SlicePicture& first) {
  const Series &under = source.opened.series, &over = overlay.opened.series;
  CaptureTags tags;
  tags.description = (source.without ? source.without->title + ": " : "") + wordsOf(stack) + ", fused with " +
                     descriptionOf(over);
  tags.seriesNumber = source.seriesNumber;
  tags.derivation = wordsOf(stack) + " of " + descriptionOf(under) +
                    (source.without ? " with air in place of " + source.without->parts : "") +
                    ", resampled with " + wordsOf(stack.first.interpolation) + " interpolation, window " +
                    first.window + "; over it " + overlay.words + "; written by volumen " VOLUMEN_VERSION;
  tags.hasNames = false;
  // The slices together may show a face in 3D.
  tags.showsFace = showFaceIn3d(under, over);
  return tags;
}

}  // namespace

Status checkWindows(const ExportJob& job) {
  if (const auto window = windowOf(job.window); !window) return window.error();
  const auto over = windowOf(job.overlay.window, "--overlay-window");
  return over ? Status() : Status(over.error());
}

Result<Exported> exportFused(const ExportJob& job, const SliceStack& stack, SeriesSource source,
                             const CancelToken& cancel) {
  Opened& opened = source.opened;
  const auto window = windowOf(job.window);
  if (!window) return window.error();
  if (Status s = checkPlane(stack.first); !s) return s.error();
  const auto overlay = openOverlay(job.overlay, job.relation, job.path, opened, cancel);
  if (!overlay) return overlay.error();
  const auto picture = [&](int n) { return slicePicture(opened, stack.plane(n), *window, *overlay, cancel); };
  const auto first = picture(0);
  if (!first) return first.error();
  const auto slices = colourSlicesOf(stack, opened, **overlay, cancel);
  if (!slices) return slices.error();
  const CaptureTags tags = fusedTags(stack, source, **overlay, *first);
  const auto slice = [&](int n) -> Result<std::vector<std::uint8_t>> {
    const auto made = picture(n);
    if (!made) return made.error();
    return rgbOf(made->image);
  };
  const Status written =
      writeColourSeries(opened.series, tags, *slices, slice, job.output, terminalProgress(), cancel);
  endTerminalProgress();
  if (!written) return written.error();
  if (tags.showsFace.value_or(false))
    opened.notes.emplace_back(
        "A face may be recognised in a rendering of the slices: look at it before you hand them on.");
  return Exported{std::move(opened.notes), opened.loaded.unread, {}};
}

}  // namespace volumen
