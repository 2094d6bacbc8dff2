#pragma once

#include "ui/exports/exports.h"

namespace volumen::tests {

/// Returns a sink that keeps its pictures.
inline PictureSink keptIn(const std::shared_ptr<std::vector<MadePicture>>& pictures) {
  const auto take = [pictures](std::size_t, const MadePicture& picture) {
    pictures->push_back(picture);
    return Status();
  };
  return {take, [](std::size_t) { return Result(QStringLiteral("Kept")); }};
}

}  // namespace volumen::tests
