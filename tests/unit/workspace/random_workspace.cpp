#include "tests/unit/workspace/random_workspace.h"

#include "tests/fixtures/chance.h"
#include "tests/unit/render/random_scenes.h"

namespace volumen::tests {
namespace {

double anyNumber(Chance& chance) {
  const double number = chance.power(-12, 6) * (chance.oneIn(2) ? -1 : 1);
  return chance.oneIn(5) ? std::round(number) : number;
}

glm::dvec3 anyPlace(Chance& chance) {
  const double x = anyNumber(chance), y = anyNumber(chance);
  return {x, y, anyNumber(chance)};
}

std::string anyText(Chance& chance) {
  static const std::vector<std::string> texts{"", "Kopf \xc3\xa4", "a \"b\"\n\t\\ \x01", "Z",
                                              "1.2.840.10008"};
  return texts[std::size_t(chance.below(int(texts.size())))];
}

VoxelGeometry anyGeometry(Chance& chance) {
  VoxelGeometry geometry;
  for (int a = 0; a < 3; ++a) {
    geometry.size[a] = 1 + chance.below(600);
    geometry.patientFromVoxelStep[a] = anyPlace(chance);
  }
  geometry.origin = anyPlace(chance);
  geometry.calibrated = !chance.oneIn(5);
  return geometry;
}

// What a session says of a series.
Series namedSeries(Chance& chance, int n) {
  Series series;
  series.format = chance.oneIn(4) ? "phantom" : "DICOM";
  series.path = (series.format == "phantom" ? "phantom:" : "/data/") + std::to_string(n) + anyText(chance);
  series.id = "id" + std::to_string(chance.below(2));
  series.seriesUid = anyText(chance);
  series.seriesNumber = anyText(chance);
  if (!chance.oneIn(3)) series.frameOfReferenceUid = "2.25." + std::to_string(chance.below(3));
  series.modality = "CT";
  series.description = anyText(chance);
  series.acquired = anyGeometry(chance);
  series.valueType = "int16";
  return series;
}

SeriesState anySeries(Chance& chance, int n) {
  SeriesState state;
  Series series = namedSeries(chance, n);
  if (chance.oneIn(3)) {
    state.missing = SeriesProof{series.acquired, series.valueType, chance.below(900), anyText(chance)};
  } else {
    series.patientName = "Doe^Jane";
    series.warnings.emplace_back("Gantry tilt.", WarningKind::sheared);
    for (int file = chance.below(4); file > 0; --file) {
      series.files.push_back(series.path + "/" + std::to_string(file));
      series.sopInstanceUids.push_back("2.25.9." + std::to_string(chance.below(1000)));
    }
  }
  state.series = std::make_shared<const Series>(std::move(series));
  state.tableRemoved = chance.oneIn(3);
  if (chance.oneIn(2)) state.window = Window{anyNumber(chance), chance.power(-3, 5)};
  return state;
}

SceneLook anyScene(Chance& chance) {
  SceneLook look{randomScene(std::uint64_t(chance.below(1 << 30))).scene, nullptr};
  if (chance.oneIn(2))
    look.preset = std::make_shared<const ChosenPreset>(
        ChosenPreset{anyText(chance), randomScene(std::uint64_t(chance.below(1 << 30))).scene});
  return look;
}

FlatLook anyFlat(Chance& chance) {
  FlatLook look;
  look.panMm = {anyNumber(chance), anyNumber(chance)};
  look.zoom = chance.power(-1, 2);
  look.slabMm = chance.oneIn(2) ? 0 : chance.power(-2, 2);
  look.slabMode = SlabMode(chance.below(3));
  look.nearest = chance.oneIn(2);
  return look;
}

}  // namespace

Workspace randomWorkspace(std::uint64_t seed) {
  Chance chance(seed);
  Workspace w;
  std::vector<SeriesKey> keys{{}};  // no series, too
  for (int n = chance.below(6); n > 0; --n) {
    const SeriesState state = anySeries(chance, n);
    keys.push_back(keyOf(*state.series));
    w.series[keys.back()] = state;
    if (chance.oneIn(2)) w.cursors[frameOfReference(*state.series)] = anyPlace(chance);
  }
  if (chance.oneIn(4)) w.cursors["2.25.77"] = anyPlace(chance);  // of a series that was closed
  for (ViewState& view : w.views) {
    view.series = keys[std::size_t(chance.below(int(keys.size())))];
    if (view.kind != ViewKind::volume) view.kind = ViewKind(1 + chance.below(3));
    for (const SeriesKey& key : keys) {
      if (chance.oneIn(3)) view.scenes[key] = anyScene(chance);
      if (chance.oneIn(3)) view.flats[key] = anyFlat(chance);
    }
  }
  w.layout = Layout(chance.below(5));
  const std::vector<ViewId> shown = viewsOnScreen(w);
  w.focus =
      w.layout == Layout::one ? chance.below(viewCount) : shown[std::size_t(chance.below(int(shown.size())))];
  w.goal.aim = Aim(chance.below(3));
  w.goal.level = {Quality(chance.below(4)), 1 << chance.below(3)};
  w.goal.frameMs = chance.power(0, 4);
  w.goal.errorOf255 = chance.power(-2, 2);
  return w;
}

}  // namespace volumen::tests
