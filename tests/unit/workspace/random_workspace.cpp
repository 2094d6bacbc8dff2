#include "tests/unit/workspace/random_workspace.h"

#include "tests/fixtures/chance.h"
#include "tests/unit/render/random_scenes.h"
#include "ui/workspace/flat_plane.h"

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

// The axes of labels must span space, or their session is refused.
VoxelGeometry anyGeometryOfLabels(Chance& chance) {
  while (true) {
    const VoxelGeometry geometry = anyGeometry(chance);
    const glm::dvec3 mm = geometry.spacing();
    if (geometry.voxelVolume() > 1e-6 * mm.x * mm.y * mm.z) return geometry;
  }
}

Mask anyMask(Chance& chance) {
  Mask mask{chance.oneIn(3), {}};
  for (int n = chance.oneIn(2) ? chance.below(4) : 0; n > 0; --n) {
    const Camera camera = randomScene(std::uint64_t(chance.below(1 << 30))).scene.camera.value_or(Camera{});
    const CameraAxes axes = cameraAxes(camera);
    Lasso lasso{anyPlace(chance), axes.right, -axes.up, chance.oneIn(2), {}, chance.oneIn(2)};
    for (int points = chance.below(30); points > 0; --points)
      lasso.points.emplace_back(anyNumber(chance), anyNumber(chance));
    mask.lassos.push_back(std::make_shared<const Lasso>(std::move(lasso)));
  }
  return mask;
}

// Returns a series with the fields that a session stores.
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
    state.missing = {{series.acquired, series.valueType, chance.below(900), anyText(chance)}, {}};
    for (int folder = chance.below(3); folder > 0; --folder)
      state.missing->folders.push_back({anyText(chance)});
  } else {
    series.patientName = "Doe^Jane";
    series.warnings.emplace_back("Gantry tilt.", WarningKind::sheared);
    for (int file = chance.below(4); file > 0; --file) {
      series.files.push_back(series.path + (chance.oneIn(3) ? "/part/" : "/") + std::to_string(file));
      series.sopInstanceUids.push_back("2.25.9." + std::to_string(chance.below(1000)));
    }
  }
  state.series = std::make_shared<const Series>(std::move(series));
  state.mask = anyMask(chance);
  state.namedGrey = chance.below(4);
  state.colours = ColourMap(chance.below(4));
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

Crosshair anyCrosshair(Chance& chance) {
  Crosshair crosshair;
  crosshair.at = anyPlace(chance);
  const ViewKind kinds[] = {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal};
  for (int turns = chance.below(4); turns > 0; --turns)
    crosshair = turnedIn(crosshair, kinds[chance.below(3)], chance.below(1000) * 0.01);
  return crosshair;
}

Measurement anyMeasurement(Chance& chance, int id, const SeriesKey& series) {
  Measurement m{id, series, {}, {}};
  m.shape.kind = chance.oneIn(2) ? ShapeKind::length : ShapeKind::rectangle;
  m.shape.name = anyText(chance);
  m.shape.points = {anyPlace(chance), anyPlace(chance)};
  if (m.shape.kind == ShapeKind::rectangle) m.shape.plane = ShapePlane{anyPlace(chance)};
  if (chance.oneIn(4)) {
    m.shape.frame = ShapeFrame{"1.2.3", 7};
    for (glm::dvec3& p : m.shape.points) p.z = 0;
    if (m.shape.plane) m.shape.plane = ShapePlane();
  }
  if (chance.oneIn(2)) m.textOffset = anyPlace(chance);
  return m;
}

RegionsLook anyRegions(Chance& chance) {
  RegionsLook look;
  look.kind = chance.oneIn(2) ? DerivedKind::contours : DerivedKind::segmentation;
  look.label = anyText(chance);
  look.frameOfReferenceUid = anyText(chance);
  look.opacity = chance.below(101) / 100.0;
  for (int n = chance.below(4); n > 0; --n) look.shown.editOrAdd(chance.below(100) - 10) = chance.oneIn(2);
  return look;
}

FlatLook anyFlat(Chance& chance, const SeriesKey& overlay) {
  FlatLook look;
  look.panMm = {anyNumber(chance), anyNumber(chance)};
  look.zoom = chance.power(-1, 2);
  look.slabMm = chance.oneIn(2) ? 0 : chance.power(-2, 2);
  look.slabMode = SlabMode(chance.below(3));
  look.nearest = chance.oneIn(2);
  look.turn = {chance.below(4), chance.oneIn(2)};
  look.inverted = chance.oneIn(2);
  look.frame = chance.below(100);
  look.layers = chance.oneIn(2);
  look.overlay = overlay;
  look.overlayColours = ColourMap(chance.below(4));
  look.overlayOpacity = chance.below(101) / 100.0;
  if (chance.oneIn(3)) look.windowAlone.emplace().namedGrey = chance.below(4);
  if (look.windowAlone && chance.oneIn(2))
    look.windowAlone->window = Window{anyNumber(chance), -chance.power(-3, 5)};
  if (chance.oneIn(3)) look.presentation = {"/data/pr" + anyText(chance), anyText(chance)};
  return look;
}

Code anyCode(Chance& chance) {
  if (chance.oneIn(3)) return {};
  std::string value = anyText(chance), scheme = anyText(chance);
  return {std::move(value), std::move(scheme), anyText(chance)};
}

std::vector<Step> anySteps(Chance& chance, int number) {
  const std::string name = std::to_string(number);
  std::vector<Step> steps{{"range", name, {{"low", anyNumber(chance)}}}, {"copy", "help", {{"other", name}}}};
  if (chance.oneIn(2)) steps.push_back({"keep", name, {{"at", std::vector<glm::dvec3>{chance.vector()}}}});
  if (chance.oneIn(2))
    steps.push_back({"joint", name, {{"with", std::vector<std::string>{"help"}}, {"sigmaMm", 2.0}}});
  if (chance.oneIn(3)) steps.push_back({"byHand", name});
  return steps;
}

// Returns a map as a session holds it, with its labels in a file.
SegmentMap anySegments(Chance& chance, const SeriesKey& key) {
  SegmentMap map{key, {}, nullptr, SavedLabels{std::string(40, "0123456789abcdef"[chance.below(16)]), {}}};
  map.missing->geometry = anyGeometryOfLabels(chance);
  for (int number = 1 + chance.below(3); number < 7; number += 1 + chance.below(4)) {
    Segment& segment = map.segments.emplace_back();
    segment.number = number;
    segment.label = anyText(chance);
    segment.category = anyCode(chance);
    segment.type = anyCode(chance);
    segment.modifier = anyCode(chance);
    segment.visible = !chance.oneIn(4);
    segment.locked = chance.oneIn(4);
    segment.opacity = chance.below(101) / 100.0;
    segment.trackingId = anyText(chance);
    if (chance.oneIn(2)) segment.trackingUid = anyText(chance);
    if (chance.oneIn(2)) segment.region = anyCode(chance), segment.regionModifier = anyCode(chance);
    segment.algorithmType = SegmentAlgorithm(chance.below(4));
    segment.algorithm = anyText(chance);
    for (int more = chance.below(3); more > 0; --more)
      segment.structures.push_back({{anyText(chance), "SCT", anyText(chance)}, {}});
    if (chance.oneIn(2))
      segment.algorithms.push_back({{"1", "DCM", anyText(chance)}, {}, anyText(chance), anyText(chance)});
    if (chance.oneIn(2))
      segment.colour = glm::u8vec3(chance.below(256), chance.below(256), chance.below(256));
    if (chance.oneIn(2)) segment.range = ValueRange{anyNumber(chance), anyNumber(chance)};
    if (segment.range && chance.oneIn(3)) segment.span = CurveSpan{chance.below(3), 1 + chance.below(3)};
    if (chance.oneIn(3)) map.current = number;
    if (chance.oneIn(2)) map.steps = anySteps(chance, number);
  }
  map.in3d = !chance.oneIn(4);
  if (chance.oneIn(3))
    map.tissue = {TissueShown::Where(chance.below(3)), chance.between(0, mostTissueMarginMm)};
  return map;
}

// Adds up to three maps with any numbers. The first one added is the active one.
void addSegmentMaps(Workspace& w, Chance& chance, const SeriesKey& key) {
  const SegmentMap first = anySegments(chance, key);
  const int count = chance.oneIn(3) ? 2 + chance.below(2) : 1, worked = chance.below(9);
  for (int n = 0; n < count; ++n) {
    SegmentMap map = n == 0 ? first : anySegments(chance, key);
    map.number = (n + worked) % 9;
    map.in3d = first.in3d, map.tissue = first.tissue;
    w.segmentMaps.push_back(std::move(map));
  }
}

}  // namespace

Workspace randomWorkspace(std::uint64_t seed) {
  Chance chance(seed);
  Workspace w;
  std::vector<SeriesKey> keys{{}};  // includes an empty key for no series
  for (int n = chance.below(6); n > 0; --n) {
    const SeriesState state = anySeries(chance, n);
    keys.push_back(keyOf(*state.series));
    w.series.editOrAdd(keys.back()) = state;
    if (chance.oneIn(2)) w.crosshairs.editOrAdd(frameOfReference(*state.series)) = anyCrosshair(chance);
  }
  if (chance.oneIn(4)) w.crosshairs.editOrAdd("2.25.77") = anyCrosshair(chance);  // a closed series
  const int looked = chance.oneIn(4) ? viewCount : 8;  // other views stay at their defaults
  for (ViewId id = 0; id < looked; ++id) {
    ViewState& view = w.editView(id);
    view.series = keys[std::size_t(chance.below(int(keys.size())))];
    if (canChangeKind(id) && view.series.empty() && chance.oneIn(3)) view.wanted = anyText(chance);
    if (canChangeKind(id))
      view.kind = ViewKind(chance.below(5));
    else if (view.kind != ViewKind::volume)
      view.kind = ViewKind(1 + chance.below(3));
    for (const SeriesKey& key : keys) {
      if (chance.oneIn(3)) view.scenes.editOrAdd(key) = anyScene(chance);
      if (chance.oneIn(3))
        view.flats.editOrAdd(key) = anyFlat(chance, keys[std::size_t(chance.below(int(keys.size())))]);
    }
  }
  for (std::size_t n = 1; n < keys.size(); ++n)
    for (int made = chance.below(3); made > 0; --made)
      w.measurements.push_back(anyMeasurement(chance, int(w.measurements.size()) + 1, keys[n]));
  w.measurementsShown = !chance.oneIn(4);
  w.links = {chance.oneIn(2), chance.oneIn(2), chance.oneIn(2), chance.oneIn(2)};
  for (const auto& [frame, crosshair] : w.crosshairs) {
    const PlaneDirections plane = crosshair.coronal;
    const glm::dmat3 rotation(plane.right, plane.down, plane.normal());
    w.frameLinks.push_back({frame, "2.25.78", {rotation, anyPlace(chance)}, chance.oneIn(2)});
    w.editView(chance.below(viewCount)).crosshairs.editOrAdd(frame) = crosshair;
  }
  for (std::size_t n = 1; n < keys.size(); ++n)
    if (chance.oneIn(2)) {
      KeyImage image{keys[n], anyText(chance), chance.below(50)};
      if (chance.oneIn(3)) image.window = ChosenWindow{Window{anyNumber(chance), -chance.power(-3, 5)}, 0};
      w.keyImages.push_back(image);
    }
  for (std::size_t n = 1; n < keys.size(); ++n)
    if (chance.oneIn(3)) addSegmentMaps(w, chance, keys[n]);
  for (int n = chance.below(3); n > 0; --n)
    w.regions.editOrAdd({"/data/rt" + std::to_string(n), anyText(chance)}) = anyRegions(chance);
  w.layout = allLayouts()[std::size_t(chance.below(int(allLayouts().size())))];
  const std::vector<ViewId> shown = viewsOnScreen(w);
  w.focus = w.layout == Layout::one ? chance.below(firstSecondId)
                                    : shown[std::size_t(chance.below(int(shown.size())))];
  w.goal.aim = Aim(chance.below(3));
  w.goal.level = {Quality(chance.below(4)), 1 << chance.below(3)};
  w.goal.frameMs = chance.power(0, 4);
  w.goal.errorOf255 = chance.power(-2, 2);
  if (chance.oneIn(3)) w = withSecondShown(std::move(w), chance.oneIn(2));
  if (chance.oneIn(3))
    w = withSecondLayout(std::move(w), allLayouts()[std::size_t(chance.below(int(allLayouts().size())))]);
  return w;
}

}  // namespace volumen::tests
