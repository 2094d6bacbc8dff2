#pragma once

#include <optional>
#include <string>

#include "io/study/identity.h"

namespace volumen {

/// Returns whether a rendering may show a recognisable face: a CT, MR or PET whose body part and
/// descriptions, in `words`, speak of the head, the neck or the whole body, in several languages.
bool mayShowFace(const std::string& modality, const std::string& words);

/// Returns whether a face can be recognised in a 3D picture of a series; empty if it does not say what it
/// shows.
std::optional<bool> showsFaceIn3d(const SeriesIdentity& series);
/// Does the same for two series that are shown together.
std::optional<bool> showFaceIn3d(const SeriesIdentity& one, const SeriesIdentity& other);

}  // namespace volumen
