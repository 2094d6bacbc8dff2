#include "io/curved.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "io/load.h"

namespace volumen {

namespace {

// Returns the 64-bit FNV-1a hash of a recipe as 16 hexadecimal digits.
std::string digestOf(const CurvedRecipe& recipe) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](double number) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (int shift = 0; shift < 64; shift += 8) hash = (hash ^ (bits >> shift & 0xff)) * 0x100000001b3;
  };
  const auto addPlace = [&](glm::dvec3 p) { add(p.x), add(p.y), add(p.z); };
  add(recipe.kind == CurvedKind::stretched), add(recipe.halfWidth);
  addPlace(recipe.ruled);
  for (const glm::dvec3 p : recipe.points) addPlace(p);
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

std::string mmText(double mm) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", mm);
  return text;
}

const VoxelGeometry& drawnGrid(const Series& series) {
  return series.regular ? series.regular->geometry : series.acquired;
}

Warning warningOf(const VoxelGeometry& curved) {
  return {
      "Resampled along a curve (voxels of " + mmText(curved.spacing().x) +
          " mm): lengths along the curve and within a cross-section are true, any other only near the curve.",
      WarningKind::curved};
}

}  // namespace

Result<Series> curvedSeries(const Series& source, const CurvedRecipe& recipe, const std::string& name) {
  if (source.curved)
    return Error{"A curve on a curved plane cannot be laid out again: draw it in the series itself."};
  const Result<CurvedGrid> grid = CurvedGrid::make(recipe, drawnGrid(source));
  if (!grid) return grid.error();
  Series series;
  static_cast<SeriesIdentity&>(series) = source;
  series.seriesUid.clear(), series.seriesNumber.clear(), series.sopClassUid.clear();
  series.frameOfReferenceUid.clear();
  series.lossyRatio = source.lossyRatio;
  series.description = name + (recipe.kind == CurvedKind::stretched ? ", stretched" : ", straightened");
  series.path = source.path;
  series.id = source.id + "#curve-" + digestOf(recipe);
  series.format = "curved plane";
  series.unit = source.unit, series.suv = source.suv;
  series.acquired = grid->geometry();
  series.valueType = "float32";
  series.warnings = {warningOf(series.acquired)};
  series.curved = CurvedFrom{std::make_shared<const Series>(source), recipe, name};
  return series;
}

const Series& sourceOf(const Series& series) { return series.curved ? *series.curved->source : series; }

Result<Series> madeLike(const Series& model, const Series& source) {
  return model.curved ? curvedSeries(source, model.curved->recipe, model.curved->name) : source;
}

Result<Loaded> loadCurved(const Series& series, VolumePtr source, const Progress& progress,
                          const CancelToken& cancel) {
  if (!source) {
    Result<Loaded> loaded = loadSeries(*series.curved->source, progress, cancel);
    if (!loaded) return loaded.error();
    source = loaded->drawn;
  }
  const auto tell = [&](std::size_t done, std::size_t total) {
    if (progress) progress("resampling along the curve", done, total);
  };
  const Result<VolumePtr> volume = curvedVolume(*source, series.curved->recipe, tell, cancel);
  if (!volume) return volume.error();
  return Loaded{*volume, *volume, series.warnings};
}

}  // namespace volumen
