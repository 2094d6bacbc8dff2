#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/files/output_file.h"
#include "io/study/warning.h"
#include "viewer/volume/picture.h"
#include "viewer/volume/result.h"

class QByteArray;
class QImage;

namespace volumen {

/// Text entries of an image file: key and value.
using PictureText = std::vector<std::pair<std::string, std::string>>;

/// Returns the 8-bit image (picture.md 6): RGB888 if the background is opaque, else RGBA8888 with straight
/// alpha.
QImage imageForFile(const Picture& picture);

/// Returns an image of the same pixels in RGB888, with black behind what is transparent.
QImage opaqueImage(const QImage& image);

/// Returns the bytes of a PNG file. The Error is the reason of the encoder.
Result<QByteArray> pngBytes(const QImage& image, const PictureText& text);

/// Writes an image of imageForFile() as JPEG for a path ending in .jpg or .jpeg, else as PNG. The file
/// appears whole or not at all. The Error: transparency in a JPEG.
Status writeImage(const QImage& image, const std::string& path, const PictureText& text);

/// Converts a picture with imageForFile() and writes it as PNG.
Status writePng(const Picture& picture, const std::string& path, const PictureText& text);

/// Returns the text entry for warnings that change what is visible: one line "KIND: sentence" each
/// (kindName()). Empty if there are none.
PictureText warningText(const std::vector<Warning>& warnings);

/// Writes the floats of a picture for comparison (design.md 10): float32, sizes 4 W H, first row on top. The
/// key "background" is "opaque" or "transparent".
Status writePictureNrrd(const Picture& picture, const std::string& path);

/// Position of a picture in the patient (LPS): centre of the first pixel and pixel steps, in mm.
struct PicturePlane {
  glm::dvec3 origin{0}, right{1, 0, 0}, down{0, 1, 0};
};

/// Writes one float a pixel: sizes W H, first row on top.
Status writeMapNrrd(glm::ivec2 size, const std::vector<float>& values, const std::string& path);

/// Creates such a file with its header alone, with its position in space if `plane` is given. The values
/// follow, then commit().
Result<OutputFile> createMapNrrd(glm::ivec2 size, const std::string& path,
                                 const std::optional<PicturePlane>& plane = {});

/// Writes three bytes a pixel (red, green, blue): sizes 3 W H, first row on top.
Status writeColourNrrd(glm::ivec2 size, const std::vector<std::uint8_t>& rgb, const std::string& path);

/// Reads a file of writePictureNrrd(). The Error: it is not float32 of sizes 4 W H.
Result<Picture> readPictureNrrd(const std::string& path);

}  // namespace volumen
