#include "app/commands/slice_frame.h"

#include <QImage>
#include <algorithm>
#include <cstring>
#include <iostream>

#include "app/command.h"
#include "app/picture_output.h"
#include "io/frames.h"

namespace volumen {

namespace {

Result<Frame> frameOf(const Study& study, const FrameOptions& options) {
  const auto image = std::ranges::find(study.images, options.series, &Image::id);
  if (image != study.images.end()) return loadFrame(*image, options.index);
  if (study.volumes.empty() && !study.images.empty()) {
    if (options.series.empty()) return loadFrame(study.images.front(), options.index);
    return Error{"--series " + options.series +
                 " names none of the pictures; \"volumen info --json\" lists their ids."};
  }
  const Result<std::size_t> series = chooseSeries(study, options.series);
  if (!series) return series.error();
  return loadFrame(study.volumes[*series], options.index);
}

QImage imageOf(const Frame& frame, const std::optional<Window>& window) {
  const auto width = std::size_t(frame.size.x);
  if (frame.colour()) {
    QImage image(frame.size.x, frame.size.y, QImage::Format_RGB888);
    for (int y = 0; y < frame.size.y; ++y)
      std::memcpy(image.scanLine(y), frame.rgb.data() + 3 * width * std::size_t(y), 3 * width);
    return image;
  }
  GreyMapping grey = frame.greys.front().mapping;
  if (window) grey.window = *window, grey.table = {};
  const std::vector<std::uint8_t> bytes = greyBytes(frame.values, grey);
  QImage image(frame.size.x, frame.size.y, QImage::Format_Grayscale8);
  for (int y = 0; y < frame.size.y; ++y)
    std::memcpy(image.scanLine(y), bytes.data() + width * std::size_t(y), width);
  return image;
}

Status write(const Frame& frame, const FrameOptions& options) {
  if (isFloatPicture(options.output))
    return frame.colour() ? writeColourNrrd(frame.size, frame.rgb, options.output)
                          : writeMapNrrd(frame.size, frame.values, options.output);
  const PictureText text{{"Software", "volumen " VOLUMEN_VERSION}, {"Comment", "Not for clinical use"}};
  return writePictureWithWarnings(imageOf(frame, options.window), text, {}, false, options.output);
}

}  // namespace

int sliceFrame(const FrameOptions& options, const CancelToken& cancel) {
  const Result<Study> study = openStudy(options.path, {}, cancel);
  if (!study) return fail(study.message(), cancel);
  const Result<Frame> frame = frameOf(*study, options);
  if (!frame) return fail(frame.message());
  for (const std::string& warning : frame->warnings) std::cerr << "volumen: " << printable(warning) << '\n';
  if (Status s = write(*frame, options); !s) return fail(s.message());
  std::cout << printable(options.output) << '\n';
  return exitDone;
}

}  // namespace volumen
