#include "io/frames.h"

#include <algorithm>
#include <iterator>

#include "io/dicom/import.h"
#include "io/dicom/parallel.h"
#include "io/frame_limit.h"
#include "io/study/image.h"

namespace volumen {
namespace {

// Checks that a slice index exists.
Status checkIndex(const Series& series, int index) {
  if (series.format != "DICOM") return Error{series.path + ": only DICOM pictures have frames as acquired."};
  if (index >= 0 && std::size_t(index) < series.files.size()) return {};
  return Error{series.path + ": there is no slice " + std::to_string(index) + " in " +
               std::to_string(series.files.size()) + "."};
}

Status checkArea(const FramePresentation& how, glm::ivec2 size) {
  const auto pixelLimit = std::int64_t(framePixelLimit());
  if (!how.area) return {};
  const glm::i64vec2 from(how.area->from), to(how.area->to), count = to - from + std::int64_t(1);
  if (from.x >= size.x || from.y >= size.y || to.x < 0 || to.y < 0)
    return Error{"the presentation state displays no part of it"};
  if (count.x > pixelLimit || count.y > pixelLimit || count.x * count.y > pixelLimit)
    return Error{"the presentation state displays an area of more than " + framePixelLimitText()};
  return {};
}

std::uint64_t pixelsOf(const Image& image) {
  return std::uint64_t(image.rows) * std::uint64_t(image.columns);
}

std::uint64_t pixelsOf(const Series& series) {
  return std::uint64_t(series.acquired.size.x) * std::uint64_t(series.acquired.size.y);
}

Result<PresentedFrame> presented(const std::string& path, std::uint64_t pixels,
                                 const std::string& sopInstanceUid, int frame,
                                 const Presentation& presentation, const Progress& progress = {}) {
  if (!namesFrame(presentation.pictures, sopInstanceUid, frame))
    return Error{path + ": the presentation state refers to other pictures."};
  dicom::Shown shown{presentation.values, presentation.inverted, presentation.shutter, {}};
  if (const auto* greys = greysFor(presentation, sopInstanceUid, frame)) shown.greys = *greys;
  Result<Frame> loaded = dicom::loadFrame(path, frame, pixels, shown, progress);
  if (!loaded) return loaded.error();
  FramePresentation how = presentationOf(presentation, sopInstanceUid, frame, loaded->size);
  if (const Status area = checkArea(how, loaded->size); !area)
    return Error{path + ": " + area.message() + "."};
  return PresentedFrame{std::move(*loaded), std::move(how)};
}

/// Frames of one file that are read together.
struct FramesOfFile {
  std::string path;
  std::vector<int> frames;
};

std::vector<FramesOfFile> framesByFile(const Series& series, const std::vector<int>& indices) {
  constexpr std::size_t mostTogether = 64;  // of those that must be decoded, within the time of one answer
  std::vector<FramesOfFile> all;
  for (const int index : indices) {
    const std::string& path = series.files[std::size_t(index)];
    if (all.empty() || all.back().path != path || all.back().frames.size() == mostTogether)
      all.push_back({path, {}});
    all.back().frames.push_back(series.frames[std::size_t(index)]);
  }
  return all;
}

}  // namespace

Result<Frame> loadFrame(const Image& image, int index) {
  return dicom::loadFrame(image.path, index, pixelsOf(image));
}

Result<Frame> loadFrame(const Series& series, int index, const Progress& progress) {
  if (const Status there = checkIndex(series, index); !there) return there.error();
  return dicom::loadFrame(series.files[std::size_t(index)], series.frames[std::size_t(index)],
                          pixelsOf(series), {}, progress);
}

Result<std::vector<Frame>> loadFrameGreys(const Series& series, const std::vector<int>& indices,
                                          const CancelToken& cancel) {
  for (const int index : indices)
    if (const Status there = checkIndex(series, index); !there) return there.error();
  const auto files = framesByFile(series, indices);
  std::vector<Result<std::vector<Frame>>> read(files.size(), std::vector<Frame>());
  dicom::forEachParallel(files.size(), "reading", {}, cancel, [&](std::size_t n) {
    read[n] = dicom::loadFrameGreys(files[n].path, files[n].frames, pixelsOf(series));
  });
  std::vector<Frame> all;
  for (auto& some : read) {
    if (!some) return some.error();
    std::ranges::move(*some, std::back_inserter(all));
  }
  return all;
}

Result<Frame> loadSmallFrame(const Image& image, int index, int edge) {
  return dicom::loadSmallFrame(image.path, index, pixelsOf(image), edge);
}

Result<Frame> loadSmallFrame(const Series& series, int index, int edge) {
  if (const Status there = checkIndex(series, index); !there) return there.error();
  return dicom::loadSmallFrame(series.files[std::size_t(index)], series.frames[std::size_t(index)],
                               pixelsOf(series), edge);
}

Result<PresentedFrame> loadFrame(const Image& image, int index, const Presentation& presentation) {
  return presented(image.path, pixelsOf(image), image.sopInstanceUid, index, presentation);
}

Result<PresentedFrame> loadFrame(const Series& series, int index, const Presentation& presentation,
                                 const Progress& progress) {
  if (const Status there = checkIndex(series, index); !there) return there.error();
  const auto n = std::size_t(index);
  return presented(series.files[n], pixelsOf(series), series.sopInstanceUids[n], series.frames[n],
                   presentation, progress);
}

}  // namespace volumen
