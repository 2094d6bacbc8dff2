#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study/series.h"

namespace volumen {

/// The weighting of an MR series.
enum class Weighting { t1, t2, t2Star, flair, diffusion, adc, protonDensity, angiography };

/// The purpose of a CT reconstruction.
enum class Kernel { soft, lung, bone };

/// Returns the weighting by words of the description, or diffusion by the b-value; empty if unknown.
std::optional<Weighting> weightingOf(const Series& series);
/// Returns the kernel by words of the description, and by the kernel itself if it separates volumes.
std::optional<Kernel> kernelOf(const Series& series);
/// Returns whether contrast agent was given, by words of the description or by the agent if it separates
/// volumes; empty if neither says.
std::optional<bool> contrastOf(const Series& series);
/// Returns whether the header says that contrast agent was given: by its name, or by words of the
/// description.
bool namesContrast(const Series& series);
/// Returns whether a text has one of the alternatives "head|brain|=fs", ignoring case. Each must begin a
/// word; "=fs" must be a whole word. No digit may follow one that ends in a digit. False without
/// alternatives.
bool hasWord(const std::string& text, const std::string& alternatives);
/// Returns whether a text is one of the alternatives "CR|DX", ignoring case.
bool isOneOf(const std::string& text, const std::string& alternatives);
/// Returns the words of letters and digits in a text, in lower case.
std::vector<std::string> wordsOf(const std::string& text);

/// Returns whether two series or objects belong to one patient: same name and same ID.
bool areOfOnePatient(const SeriesIdentity& a, const SeriesIdentity& b);
/// Returns the grid on which a series is drawn.
const VoxelGeometry& drawnGeometry(const Series& series);

}  // namespace volumen
