#pragma once

#include <string>

namespace volumen {

/// Returns whether a rendering may show a recognisable face: a CT, MR or PET whose body part and
/// descriptions, in `words`, speak of the head, the neck or the whole body, in several languages.
bool mayShowFace(const std::string& modality, const std::string& words);

}  // namespace volumen
