#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study/series.h"
#include "ui/workspace/view_kind.h"

namespace volumen {

/// How an MR series is weighted.
enum class Weighting { t1, t2, t2Star, flair, diffusion, adc, protonDensity, angiography };

/// What a CT was reconstructed for.
enum class Kernel { soft, lung, bone };

/// By the words of the description, and of diffusion by the b-value; none: nothing tells.
std::optional<Weighting> weightingOf(const Series& series);
/// By the words of the description and, where it tells volumes apart, the kernel itself.
std::optional<Kernel> kernelOf(const Series& series);
/// Whether contrast agent was given, where the words of the description say it.
std::optional<bool> contrastOf(const Series& series);
/// Whether the header says that contrast agent was given: by its name, or by the words of the description.
bool namesContrast(const Series& series);
/// The plane of the patient that its slices are closest to; none: not calibrated, or no volume.
std::optional<ViewKind> acquiredPlaneOf(const Series& series);

/// Whether a text has one of the alternatives "head|brain|=fs", each at the beginning of a word, "=fs" as a
/// whole one, upper or lower case; what ends in a digit is followed by none. No alternatives: false.
bool hasWord(const std::string& text, const std::string& alternatives);
/// Whether a text is one of the alternatives "CR|DX", upper or lower case.
bool isOneOf(const std::string& text, const std::string& alternatives);
/// The words of a text of letters and digits, in lower case.
std::vector<std::string> wordsOf(const std::string& text);

}  // namespace volumen
