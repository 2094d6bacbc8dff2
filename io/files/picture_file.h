#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/study/warning.h"
#include "viewer/volume/picture.h"
#include "viewer/volume/result.h"

class QImage;

namespace volumen {

/// What a picture's file says of it: key and value.
using PictureText = std::vector<std::pair<std::string, std::string>>;

/// The 8-bit picture (picture.md 6): RGB888 where the background is opaque, else RGBA8888 with straight
/// colour.
QImage imageForFile(const Picture& picture);

/// Writes an image of imageForFile(), as JPEG where the path ends in .jpg or .jpeg, else as PNG. The file
/// appears whole or not at all. Refused: transparency in a JPEG.
Status writeImage(const QImage& image, const std::string& path, const PictureText& text);

/// Both at once, as PNG.
Status writePng(const Picture& picture, const std::string& path, const PictureText& text);

/// The text of a picture that the warnings which change what is seen stand in: each "KIND: sentence" in a
/// line of its own (kindName()); empty without any.
PictureText warningText(const std::vector<Warning>& warnings);

/// Writes the floats themselves for comparison (design.md 10): float32, sizes 4 W H, first row on top; the
/// key "background" says "opaque" or "transparent".
Status writePictureNrrd(const Picture& picture, const std::string& path);

/// Where a picture lies in the patient (LPS): the centre of its first pixel and the steps from one to the
/// next, mm.
struct PicturePlane {
  glm::dvec3 origin{0}, right{1, 0, 0}, down{0, 1, 0};
};

/// One float a pixel: sizes W H, first row on top; with its place in space, where that is given.
Status writeMapNrrd(glm::ivec2 size, const std::vector<float>& values, const std::string& path,
                    const std::optional<PicturePlane>& plane = {});

/// Three bytes a pixel, red, green, blue: sizes 3 W H, first row on top.
Status writeColourNrrd(glm::ivec2 size, const std::vector<std::uint8_t>& rgb, const std::string& path);

/// Reads what writePictureNrrd wrote. Refused: what is not float32 of sizes 4 W H.
Result<Picture> readPictureNrrd(const std::string& path);

}  // namespace volumen
