#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/open_volume.h"
#include "app/option_words.h"
#include "results/numbers/measured_shape.h"

namespace volumen {

/// The words of --unit.
const OptionWords<PetUnit>& petUnitWords();
/// Returns the unit of a word of --unit; SUVbw for an empty one.
PetUnit petUnitOf(const std::string& word);
/// Returns the scale of a series' values in the unit of a word of --unit, by default SUVbw if available. The
/// Error: the requested unit is not available.
Result<ValueScale> scaleFor(const Series& series, const std::string& unit);

/// Reads the file of --roi; no shapes if none is named.
Result<std::vector<Shape>> readShapes(const std::string& path);

/// Returns "[2] (length "lesion")", as error messages of shapes count.
std::string shapeWords(const std::vector<Shape>& shapes, std::size_t n);

/// The sources to measure shapes on, as far as they are needed.
struct ShapeSources {
  std::optional<Opened> volume;
  FramesToMeasure frames;
};
/// Opens the series `series` of a study, openStudyAt(path), unless all shapes are on frames, and its frames
/// if shapes are on some. `needsVolume`: the volume is needed besides.
Result<ShapeSources> openForShapes(const Study& study, const std::string& path, const std::string& series,
                                   const std::vector<Shape>& shapes, bool needsVolume, const MemoryUse& use,
                                   const CancelToken& cancel);

/// Returns the volume of the sources, if there is one, to measure shapes in.
ShapesVolume volumeOf(const ShapeSources& sources);
/// Returns shapes with the names of shapeWords(); those that are not on frames are in `volume`.
std::vector<ShapeToMeasure> shapesToMeasure(const std::vector<Shape>& shapes, const ShapesVolume& volume);

}  // namespace volumen
