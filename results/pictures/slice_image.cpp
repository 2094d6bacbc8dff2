#include "results/pictures/slice_image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "results/pictures/colour_mix.h"
#include "viewer/slice/slice.h"

namespace volumen {

namespace {

QImage greyImage(const SliceValues& slice, const GreyMapping& grey) {
  const std::vector<std::uint8_t> bytes = greyBytes(slice.values, grey);
  QImage image(slice.size.x, slice.size.y, QImage::Format_Grayscale8);
  for (int y = 0; y < slice.size.y; ++y)
    std::copy_n(bytes.begin() + std::ptrdiff_t(y) * slice.size.x, slice.size.x, image.scanLine(y));
  return image;
}

// The image has 32 bits per pixel, so that rows follow each other without a gap.
std::span<std::uint32_t> pixelsOf(QImage& image) {
  return {reinterpret_cast<std::uint32_t*>(image.bits()),
          std::size_t(image.width()) * std::size_t(image.height())};
}

QImage colourImage(const SliceValues& slice, const GreyMapping& grey, ColourMap map) {
  const std::vector<std::uint8_t> bytes = greyBytes(slice.values, grey);
  QImage image(slice.size.x, slice.size.y, QImage::Format_RGB32);
  const ColourTable& colours = colourTable(map);
  std::ranges::transform(bytes, slice.values, pixelsOf(image).begin(), [&](std::uint8_t byte, float value) {
    return std::isnan(value) ? 0xff000000u : colours[byte];
  });
  return image;
}

}  // namespace

SlicePlane planeMovedBy(SlicePlane plane, const Rigid& rigid) {
  if (rigid == Rigid{}) return plane;
  plane.centre = rigid(plane.centre);
  plane.right = glm::normalize(rigid.rotation * plane.right);
  plane.down = rigid.rotation * plane.down;
  plane.down = glm::normalize(plane.down - glm::dot(plane.down, plane.right) * plane.right);
  return plane;
}

// Tints the voxels of the range on the plane itself, without slab or interpolation.
Result<QImage> withTint(QImage picture, const SliceLayer& layer, SlicePlane plane) {
  plane.slabMm = 0;
  plane.interpolation = Interpolation::nearest;
  plane.average = false;
  const Result<SliceValues> slice = resampleSlice(*layer.volume, plane);
  if (!slice) return slice.error();
  if (picture.format() != QImage::Format_RGB32) picture = picture.convertToFormat(QImage::Format_RGB32);
  const ColourMix mixed(layer.tinted->colour, layer.opacity);
  const ValueRange range = layer.tinted->range;
  const std::span<std::uint32_t> pixels = pixelsOf(picture);
  for (std::size_t n = 0; n < pixels.size(); ++n)
    if (holds(range, double(slice->values[n]))) pixels[n] = mixed(pixels[n]);  // no range contains NaN
  return picture;
}

Result<QImage> sliceImage(const std::vector<SliceLayer>& layers, const SlicePlane& plane) {
  QImage image;
  for (const SliceLayer& layer : layers) {
    const Result<SliceValues> slice = resampleSlice(*layer.volume, planeMovedBy(plane, layer.fromPlane));
    if (!slice) return Error{slice.message()};
    if (image.isNull()) {
      const bool plain = layers.size() == 1 && layer.colours == ColourMap::grey;
      image = plain ? greyImage(*slice, layer.grey) : colourImage(*slice, layer.grey, layer.colours);
    } else {
      layOver(pixelsOf(image), slice->values, layer.grey, layer.colours, layer.opacity);
    }
  }
  return image;
}

}  // namespace volumen
