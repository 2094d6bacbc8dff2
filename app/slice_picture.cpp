#include "app/slice_picture.h"

#include <cstring>
#include <new>
#include <nlohmann/json.hpp>

#include "app/plane_options.h"
#include "viewer/slice/first_window.h"

namespace volumen {

namespace {

std::string windowText(const GreyMapping& grey) {
  const nlohmann::json centre = grey.window.centre, width = grey.window.width;
  return (grey.function == WindowFunction::linear ? "LINEAR " : "LINEAR_EXACT ") + centre.dump() + "," +
         width.dump();
}

// Resamples and maps rows as they come: all values at once would be twice a radiograph's memory.
Result<QImage> greyImage(const Volume& volume, const SlicePlane& plane, const GreyMapping& grey,
                         const CancelToken& cancel) {
  QImage image(plane.size.x, plane.size.y, QImage::Format_Grayscale8);
  if (image.isNull()) throw std::bad_alloc();
  const auto width = std::size_t(plane.size.x);
  int y = 0;
  const auto use = [&](std::span<const float> rows) -> Status {
    const std::vector<std::uint8_t> bytes = greyBytes(rows, grey);
    for (std::size_t n = 0; n < bytes.size(); n += width) std::memcpy(image.scanLine(y++), &bytes[n], width);
    return {};
  };
  if (Status s = resampleSliceByRows(volume, plane, use, cancel); !s) return s.error();
  return image;
}

}  // namespace

Result<SlicePicture> slicePicture(const Opened& opened, const SlicePlane& plane,
                                  const std::optional<Window>& window, const std::optional<Overlay>& overlay,
                                  const CancelToken& cancel) {
  const Volume& volume = *opened.loaded.drawn;
  const GreyMapping grey = windowGrey(volume, opened.series.format == "DICOM",
                                      window ? *window : firstWindow(volume, opened.series.unit));
  auto image = overlay ? sliceImage({{opened.loaded.drawn, grey}, overlay->layer}, plane)
                       : greyImage(volume, plane, grey, cancel);
  if (!image) return image.error();
  return SlicePicture{*std::move(image), windowText(grey), overlay ? overlay->words : std::string()};
}

PictureText sliceText(const SlicePlane& plane, const SlicePicture& picture) {
  PictureText text = {{"Software", "volumen " VOLUMEN_VERSION},
                      {"Comment", "Not for clinical use"},
                      {"volumen-plane", planeJson(plane).dump()},
                      {"volumen-window", picture.window}};
  if (!picture.overlay.empty()) text.emplace_back("volumen-overlay", picture.overlay);
  return text;
}

}  // namespace volumen
