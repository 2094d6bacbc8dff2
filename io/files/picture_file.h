#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/picture.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Writes the 8-bit picture (SCENE 6): RGB where the background is opaque, else RGBA with straight colour,
/// and `text` (key, value) as PNG text. The file appears whole or not at all.
Status writePng(const Picture& picture, const std::string& path,
                const std::vector<std::pair<std::string, std::string>>& text);

/// Writes the floats themselves for comparison (DESIGN 10): float32, sizes 4 W H, first row on top; the key
/// "background" says "opaque" or "transparent".
Status writePictureNrrd(const Picture& picture, const std::string& path);

/// One float a pixel: sizes W H, first row on top.
Status writeMapNrrd(glm::ivec2 size, const std::vector<float>& values, const std::string& path);

/// Reads what writePictureNrrd wrote. Refused: what is not float32 of sizes 4 W H.
Result<Picture> readPictureNrrd(const std::string& path);

}  // namespace volumen
