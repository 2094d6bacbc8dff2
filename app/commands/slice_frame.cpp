#include "app/commands/slice_frame.h"

#include <QImage>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <utility>

#include "app/command.h"
#include "app/frame_picture.h"
#include "app/open_volume.h"
#include "app/picture_output.h"
#include "app/report_files.h"
#include "io/frames.h"
#include "io/paths/open_path.h"
#include "io/study/choose.h"
#include "results/pictures/paint_graphics.h"

namespace volumen {

namespace {

// The source of frames: an image or a series.
struct Source {
  const Image* image = nullptr;
  const Series* series = nullptr;

  // Returns how many frames a presentation state can reference; 0 for a series that is not DICOM.
  int count() const { return image ? image->frames : int(series->sopInstanceUids.size()); }
  bool isNamedBy(const Presentation& p, int n) const {
    if (image) return namesFrame(p.pictures, image->sopInstanceUid, n);
    const auto at = std::size_t(n);
    return namesFrame(p.pictures, series->sopInstanceUids[at], series->frames[at]);
  }
  template <class... Shown>
  auto load(int n, const Shown&... shown) const {
    return image ? loadFrame(*image, n, shown...) : loadFrame(*series, n, shown...);
  }
};

Result<Source> sourceOf(const Study& study, const FrameOptions& options) {
  const auto image = std::ranges::find(study.images, options.series, &Image::id);
  if (image != study.images.end()) return Source{&*image, nullptr};
  if (study.volumes.empty() && study.images.empty()) return nothingToShow(options.path, study);
  if (study.volumes.empty()) {
    if (options.series.empty()) return Source{&study.images.front(), nullptr};
    return Error{"--series " + options.series +
                 " names none of the pictures; \"volumen info --json\" lists their ids."};
  }
  const Result<std::size_t> series = chooseSeries(study, options.series);
  if (!series) return series.error();
  return Source{nullptr, &study.volumes[*series]};
}

// Returns the file that --presentation means.
Result<std::string> presentationFile(const Study& study, const std::string& text) {
  const bool isNumber = text.find_first_not_of("0123456789") == std::string::npos && text.size() <= 9;
  if (!isNumber) return text;
  const std::size_t number = std::stoul(text);
  const std::size_t count = study.derived.size();
  if (number >= 1 && number <= count) return study.derived[number - 1].path;
  if (count == 0) return Error{"--presentation " + text + ": no object here refers to pictures."};
  return Error{"--presentation " + text +
               ": \"volumen info\" numbers the objects that refer to pictures from 1 to " +
               std::to_string(count) + "."};
}

// Returns the first frame that a presentation state references.
std::optional<std::pair<Source, int>> firstNamed(const std::vector<Source>& sources,
                                                 const Presentation& presentation) {
  for (const Source& source : sources)
    for (int n = 0; n < source.count(); ++n)
      if (source.isNamedBy(presentation, n)) return std::pair(source, n);
  return {};
}

// Returns the error that no referenced image is present; it lists images without pixels.
Error namesNothing(const Study& study, const std::string& path) {
  std::string why;
  for (const Other& other : study.other) {
    const bool isDerivedObject =
        std::ranges::find(study.derived, other.path, &DerivedObject::path) != study.derived.end();
    if (!isDerivedObject && other.kind.find("without pixel data") != std::string::npos)
      why += "\n" + other.path + ": " + other.kind + ".";
  }
  return Error{path + " holds none of the pictures that the presentation state refers to." + why};
}

// Returns the requested image, else the first one that a presentation state references.
Result<std::pair<Source, int>> presentedSource(const Study& study, const FrameOptions& options,
                                               const Presentation& presentation) {
  std::vector<Source> sources;
  if (options.index || !options.series.empty()) {
    const Result<Source> source = sourceOf(study, options);
    if (!source) return source.error();
    if (options.index) return std::pair(*source, *options.index);
    sources.push_back(*source);
  } else {
    for (const Series& series : study.volumes)
      if (series.format == "DICOM") sources.push_back({nullptr, &series});
    for (const Image& image : study.images) sources.push_back({&image, nullptr});
  }
  const auto named = firstNamed(sources, presentation);
  if (!named) return namesNothing(study, options.path);
  return *named;
}

void closeShutter(const Frame& frame, std::vector<std::uint8_t>& bytes) {
  const std::size_t channels = frame.colour() ? 3 : 1;
  const auto grey = std::uint8_t(255 * frame.shutterGrey + 0.5f);
  for (std::size_t n = 0; n < frame.shutter.size(); ++n)
    if (frame.shutter[n]) std::fill_n(bytes.begin() + std::ptrdiff_t(n * channels), channels, grey);
}

Status writeImage(const QImage& image, const std::string& path) {
  const PictureText text{{"Software", "volumen " VOLUMEN_VERSION}, {"Comment", "Not for clinical use"}};
  return writePictureWithWarnings(image, text, {}, false, path);
}

// Writes a float picture row by row: all values at once would be twice the memory of the stored ones.
Status writeRows(glm::ivec2 size, const std::string& path,
                 const std::function<std::vector<float>(int y)>& rowAt) {
  auto out = createMapNrrd(size, path);
  if (!out) return out.error();
  for (int y = 0; y < size.y; ++y) {
    const std::vector<float> row = rowAt(y);
    if (Status s = out->write(row.data(), row.size() * sizeof(float)); !s) return s;
  }
  return out->commit();
}

Status write(const Frame& frame, const FrameOptions& options) {
  const auto rowAt = [&](int y) {
    const auto width = std::size_t(frame.size.x);
    return frame.values.floats(std::size_t(y) * width, width);
  };
  if (isFloatPicture(options.output))
    return frame.colour() ? writeColourNrrd(frame.size, frame.rgb, options.output)
                          : writeRows(frame.size, options.output, rowAt);
  return writeImage(pictureOfBytes(frameBytes(frame, options.window), frame.size, frame.colour()),
                    options.output);
}

Status write(const PresentedFrame& shown, const FrameOptions& options) {
  const Frame& frame = shown.frame;
  const PresentedGrid grid(shown.how, frame.size);
  const int channels = frame.colour() ? 3 : 1;
  const auto rowAt = [&](int y) {
    std::vector<float> row(std::size_t(grid.size().x), std::numeric_limits<float>::quiet_NaN());
    for (int x = 0; x < grid.size().x; ++x) {
      const glm::ivec2 p = grid.pixelAt({x, y});
      if (p.x >= 0 && p.y >= 0 && p.x < frame.size.x && p.y < frame.size.y)
        row[std::size_t(x)] = frame.values[std::size_t(p.y) * std::size_t(frame.size.x) + std::size_t(p.x)];
    }
    return row;
  };
  if (isFloatPicture(options.output) && !frame.colour()) return writeRows(grid.size(), options.output, rowAt);
  std::vector<std::uint8_t> bytes = frameBytes(frame, options.window);
  if (isFloatPicture(options.output))
    return writeColourNrrd(grid.size(), presentPixels(grid, bytes, frame.size, channels, std::uint8_t(0)),
                           options.output);
  closeShutter(frame, bytes);
  QImage image = pictureOfBytes(presentPixels(grid, bytes, frame.size, channels, std::uint8_t(0)),
                                grid.size(), frame.colour());
  if (options.graphics) {
    prepareFonts();
    paintGraphics(image, shown.how, grid);
  }
  return writeImage(image, options.output);
}

// Prints warnings about parts that are not displayed, and writes the picture.
template <class Shown>
Status finish(const Result<Shown>& shown, const std::vector<std::string>& warnings,
              const FrameOptions& options) {
  if (!shown) return shown.error();
  printNotes(warnings);
  return write(*shown, options);
}

// Prints the losses of the frame's series, or refuses the series because of them.
Status tellLosses(const Source& source, int& status) {
  if (!source.series || source.series->unread.empty()) return {};
  if (Status whole = checkLosses(source.series->path, source.series->unread); !whole) return whole;
  printNotes(unreadSentences({source.series}));
  status = exitLosses;
  return {};
}

Status drawPresented(const Study& study, const FrameOptions& options, int& status) {
  const Result<std::string> file = presentationFile(study, options.presentation);
  if (!file) return file.error();
  const Result<Presentation> presentation = loadPresentation(*file);
  if (!presentation) return presentation.error();
  printNotes(presentation->warnings);
  const auto source = presentedSource(study, options, *presentation);
  if (!source) return source.error();
  if (Status told = tellLosses(source->first, status); !told) return told;
  const Result<PresentedFrame> shown = source->first.load(source->second, *presentation);
  return finish(shown, shown ? shown->frame.warnings : std::vector<std::string>(), options);
}

Status drawAcquired(const Study& study, const FrameOptions& options, int& status) {
  const Result<Source> source = sourceOf(study, options);
  if (!source) return source.error();
  if (Status told = tellLosses(*source, status); !told) return told;
  const Result<Frame> frame = source->load(options.index.value_or(0));
  return finish(frame, frame ? frame->warnings : std::vector<std::string>(), options);
}

}  // namespace

int sliceFrame(const FrameOptions& options, const CancelToken& cancel) {
  const Result<Study> study = openPath(options.path, {}, cancel);
  if (!study) return fail(study.message(), cancel);
  int status = exitDone;
  const Status drawn = options.presentation.empty() ? drawAcquired(*study, options, status)
                                                    : drawPresented(*study, options, status);
  if (!drawn) return fail(drawn.message());
  std::cout << printable(options.output) << '\n';
  return status;
}

}  // namespace volumen
