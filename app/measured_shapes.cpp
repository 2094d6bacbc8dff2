#include "app/measured_shapes.h"

#include <algorithm>

#include "io/regular_file.h"
#include "io/study/frame_series.h"
#include "viewer/measure/shape_json.h"

namespace volumen {

const OptionWords<PetUnit>& petUnitWords() {
  static const OptionWords<PetUnit> words{{"SUVbw", PetUnit::suvBodyWeight},
                                          {"SUVlbm", PetUnit::suvLeanBodyMass},
                                          {"SUVbsa", PetUnit::suvBodySurface},
                                          {"file", PetUnit::file}};
  return words;
}

PetUnit petUnitOf(const std::string& word) {
  return word.empty() ? PetUnit::suvBodyWeight : meaning(petUnitWords(), word);
}

Result<ValueScale> scaleFor(const Series& series, const std::string& unit) {
  const PetUnit wanted = petUnitOf(unit);
  ValueScale scale = valueScale(series, wanted);
  if (unit.empty() || wanted == PetUnit::file || scale.unit == unit) return scale;
  return Error{series.path + ": " + (scale.why.empty() ? "no SUV: it is no PET series" : scale.why) + "."};
}

Result<std::vector<Shape>> readShapes(const std::string& path) {
  if (path.empty()) return std::vector<Shape>();
  constexpr std::uint64_t mostBytes = 16 << 20;
  const auto file = RegularFile::open(path);
  if (!file) return Error{"Cannot read the shapes " + path + ": " + file.message() + "."};
  std::vector<std::uint8_t> text;
  if (const Status read = file->readUpTo(text, mostBytes); !read)
    return Error{"Cannot read the shapes " + path + ": " + read.message() + "."};
  Result<std::vector<Shape>> shapes = shapesFromJson({text.begin(), text.end()});
  if (!shapes) return Error{path + ": " + shapes.message()};
  return shapes;
}

std::string shapeWords(const std::vector<Shape>& shapes, std::size_t n) {
  const std::string name = shapes[n].name.empty() ? "" : " \"" + shapes[n].name + "\"";
  return "[" + std::to_string(n) + "] (" + ruleOf(shapes[n].kind).name + name + ")";
}

Result<ShapeSources> openForShapes(const Study& study, const std::string& path, const std::string& series,
                                   const std::vector<Shape>& shapes, bool needsVolume, const MemoryUse& use,
                                   const CancelToken& cancel) {
  const auto isOnFrame = [](const Shape& shape) { return shape.frame.has_value(); };
  ShapeSources sources;
  if (needsVolume || !std::ranges::all_of(shapes, isOnFrame)) {
    Result<Opened> opened = openVolume(study, path, series, cancel, use);
    if (!opened) return opened.error();
    sources.volume = std::move(*opened);
  }
  if (std::ranges::none_of(shapes, isOnFrame)) return sources;
  std::vector<Series> frames = frameSeries(study);
  frames.insert(frames.end(), study.volumes.begin(), study.volumes.end());
  sources.frames = FramesToMeasure(std::move(frames));
  return sources;
}

ShapesVolume volumeOf(const ShapeSources& sources) {
  if (!sources.volume) return {};
  const Loaded& loaded = sources.volume->loaded;
  return {sources.volume->series, loaded.drawn, loaded.origins, loaded.places};
}

std::vector<ShapeToMeasure> shapesToMeasure(const std::vector<Shape>& shapes, const ShapesVolume& volume) {
  std::vector<ShapeToMeasure> all;
  for (std::size_t n = 0; n < shapes.size(); ++n)
    all.push_back({shapes[n], shapeWords(shapes, n), shapes[n].frame ? nullptr : &volume});
  return all;
}

}  // namespace volumen
