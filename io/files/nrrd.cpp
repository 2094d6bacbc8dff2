#include "io/files/nrrd.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "io/files/header_text.h"

namespace volumen {

namespace {

using Vector = std::optional<std::vector<double>>;  // empty for "none"

struct Space {
  std::size_t dimension = 0;  // 0: the header gives no space
  glm::dvec3 toLps{1};        // sign of each axis
  bool anatomical = false;
};

Result<Space> parseSpace(const NrrdHeader& header, const std::string& path) {
  static const std::map<std::string, Space> spaces{{"right-anterior-superior", {3, {-1, -1, 1}, true}},
                                                   {"ras", {3, {-1, -1, 1}, true}},
                                                   {"left-anterior-superior", {3, {1, -1, 1}, true}},
                                                   {"las", {3, {1, -1, 1}, true}},
                                                   {"left-posterior-superior", {3, {1, 1, 1}, true}},
                                                   {"lps", {3, {1, 1, 1}, true}},
                                                   {"scanner-xyz", {3}},
                                                   {"3d-right-handed", {3}},
                                                   {"3d-left-handed", {3, {1, 1, -1}}}};
  std::string name = lowerCase(header.field("space"));
  const std::string dimension = header.field("spacedimension");
  if (name.empty() && dimension.empty()) return Space{};
  if (name.empty()) {
    const auto n = toInteger(dimension);
    if (!n || *n < 1 || *n > 4)
      return Error{path + " has the space dimension '" + fieldText(dimension) + "'; volumen reads 1 to 4."};
    return Space{std::size_t(*n)};
  }
  constexpr std::string_view timeEnd = "-time";
  const bool time = name.size() > timeEnd.size() && name.ends_with(timeEnd);
  const bool shortTime = name == "rast" || name == "last" || name == "lpst";
  if (time || shortTime) name.resize(name.size() - (time ? timeEnd.size() : 1));
  const auto found = spaces.find(name);
  if (found == spaces.end())
    return Error{path + " has the unknown space '" + fieldText(header.field("space")) + "'."};
  Space space = found->second;
  space.dimension += time || shortTime;
  return space;
}

// Parses "(1,0,0) none (0, 1, 0)": vectors of `dimension` numbers each.
std::optional<std::vector<Vector>> parseVectors(std::string_view text, std::size_t dimension) {
  std::vector<Vector> vectors;
  while (!(text = trimmed(text)).empty()) {
    if (lowerCase(text.substr(0, 4)) == "none") {
      vectors.emplace_back();
      text.remove_prefix(4);
      continue;
    }
    const std::size_t end = text.find(')');
    if (text[0] != '(' || end == std::string_view::npos) return {};
    std::string inner(text.substr(1, end - 1));
    std::replace(inner.begin(), inner.end(), ',', ' ');
    const auto numbers = toNumbers(inner);
    if (!numbers || numbers->size() != dimension) return {};
    vectors.emplace_back(*numbers);
    text.remove_prefix(end + 1);
  }
  return vectors;
}

glm::dvec3 inLps(const std::vector<double>& v, const Space& space) {
  glm::dvec3 p(0);
  for (std::size_t a = 0; a < std::min<std::size_t>(3, v.size()); ++a) p[int(a)] = v[a];
  return p * space.toLps;
}

// Returns mm per unit; empty if the unit is not a length.
std::optional<double> millimetres(const std::string& unit) {
  static const std::map<std::string, double> units{
      {"mm", 1},   {"millimeter", 1}, {"millimeters", 1}, {"millimetre", 1}, {"cm", 10},
      {"m", 1000}, {"um", 1e-3},      {"micron", 1e-3},   {"microns", 1e-3}, {"nm", 1e-6}};
  const auto found = units.find(lowerCase(unit));
  if (found == units.end()) return {};
  return found->second;
}

// Returns the quoted texts of a field such as `units: "mm" "" "s"`.
std::vector<std::string> quotedParts(std::string_view text) {
  std::vector<std::string> all;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string_view::npos;) {
    const std::size_t end = text.find('"', at + 1);
    if (end == std::string_view::npos) break;
    all.emplace_back(text.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return all;
}

// Returns mm per unit of entry `axis` in the field `name`; warns if that is not mm.
double unitMm(const NrrdHeader& header, const char* name, std::size_t axis, std::vector<Warning>& warnings) {
  const auto units = quotedParts(header.field(name));
  if (axis >= units.size() || units[axis].empty()) return 1;
  const auto mm = millimetres(units[axis]);
  const Warning warning(
      "The header gives lengths in '" + fieldText(units[axis]) +
      (mm ? "'; they were turned into mm." : "', which volumen does not know; they are taken as mm."));
  if (mm != 1.0 && std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
    warnings.push_back(warning);
  return mm.value_or(1);
}

bool isVolumeKind(const std::string& kind) {
  return kind.empty() || kind == "domain" || kind == "space" || kind == "???" || kind == "none";
}

Status refuseKind(const std::string& kind, const std::string& path) {
  static const std::set<std::string> colours{"rgb", "rgba", "hsv", "xyz", "3", "4"};
  std::string name = kind.substr(0, kind.rfind("color"));  // "RGB-color", "RGBcolor", "RGB"
  if (name.ends_with('-')) name.pop_back();
  if (colours.contains(name)) return Error{path + " is a colour image: it cannot be shown in 3D."};
  if (kind == "complex") return Error{path + " holds complex numbers, which cannot be shown."};
  return {};
}

// The axes that span the grid. They are adjacent; axes before and after them count volumes.
struct GridAxes {
  std::size_t first = 0, count = 0;
};

Result<GridAxes> gridAxes(const NrrdHeader& header, const std::optional<std::vector<Vector>>& directions,
                          const std::vector<std::string>& kinds, const std::string& path) {
  const std::size_t axes = header.sizes.size();
  std::vector<bool> isGrid(axes);
  for (std::size_t a = 0; a < axes; ++a) {
    const auto timeOnly = [](const std::vector<double>& v) {
      return v.size() == 4 && v[0] == 0 && v[1] == 0 && v[2] == 0;
    };
    const auto nothing = [&](const std::vector<double>& v) {  // ITK writes zeros for "none"
      return !isVolumeKind(kinds[a]) && std::ranges::all_of(v, [](double x) { return std::abs(x) < 1e-30; });
    };
    const auto inSpace = [&](const std::vector<double>& v) { return !timeOnly(v) && !nothing(v); };
    isGrid[a] = directions ? (*directions)[a] && inSpace(*(*directions)[a]) : isVolumeKind(kinds[a]);
    if (!isGrid[a] && header.sizes[a] > 1)
      if (Status s = refuseKind(kinds[a], path); !s) return s.error();
  }
  const std::size_t first = std::find(isGrid.begin(), isGrid.end(), true) - isGrid.begin();
  std::size_t end = first;
  while (end < axes && isGrid[end]) ++end;
  if (first == axes) return Error{path + " has no axis in space, so it holds no volume."};
  if (std::find(isGrid.begin() + end, isGrid.end(), true) != isGrid.end())
    return Error{path + " has other axes between those of its volume, which volumen does not read."};
  return GridAxes{first, std::min<std::size_t>(3, end - first)};
}

OuterAxis outerAxis(const std::string& kind, std::uint64_t size, bool isDiffusion) {
  using enum OuterAxis::Kind;
  if (kind == "time") return {time, size};
  if (kind == "list") return {isDiffusion ? direction : other, size};
  const bool isVector =
      kind.find("vector") != std::string::npos || kind.find("gradient") != std::string::npos ||
      kind.find("normal") != std::string::npos || kind == "point" || kind.find("matrix") != std::string::npos;
  return {isVector ? component : other, size};
}

// Sets the b-value of each direction by NA-MIC's keys: the nominal one belongs to the longest gradient.
void nameDiffusion(const NrrdHeader& header, std::vector<VolumeName>& names) {
  const auto nominal = header.keyValues.find("DWMRI_b-value");
  const auto b = nominal == header.keyValues.end() ? std::nullopt : toNumber(trimmed(nominal->second));
  if (!b || !std::isfinite(*b)) return;
  std::vector<double> squares;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const std::string number = std::to_string(n);
    const std::string key = "DWMRI_gradient_" + std::string(4 - std::min<std::size_t>(4, number.size()), '0');
    const auto gradient = header.keyValues.find(key + number);
    const auto g = gradient == header.keyValues.end() ? std::nullopt : toNumbers(gradient->second);
    if (!g || g->size() != 3) return;
    squares.push_back((*g)[0] * (*g)[0] + (*g)[1] * (*g)[1] + (*g)[2] * (*g)[2]);
  }
  const double longest = *std::max_element(squares.begin(), squares.end());
  if (!(longest > 0) || !std::isfinite(longest)) return;
  for (std::size_t n = 0; n < names.size(); ++n)
    names[n].bValue = exactText(std::round(*b * squares[n] / longest));
}

// Returns the names of a file's volumes from the axes before and after the grid.
std::vector<VolumeName> namesOf(const NrrdHeader& header, GridAxes grid,
                                const std::vector<std::string>& kinds) {
  const auto modality = header.keyValues.find("modality");
  const bool isDiffusion = modality != header.keyValues.end() && trimmed(modality->second) == "DWMRI";
  std::vector<OuterAxis> axes;
  for (std::size_t a = 0; a < header.sizes.size(); ++a)
    if (a < grid.first || a >= grid.first + grid.count)
      axes.push_back(outerAxis(kinds[a], header.sizes[a], isDiffusion));
  std::vector<VolumeName> names = volumeNames(axes);
  if (isDiffusion) nameDiffusion(header, names);
  return names;
}

// True if a non-anatomical space has mirrored coordinates.
bool isLeftHanded(const Space& space) { return !space.anatomical && space.toLps.z < 0; }

// Sets a grid along the axes from spacings and axis mins / maxs; its orientation in the patient is unknown.
Result<bool> geometryFromSpacings(const NrrdHeader& header, const Space& space, GridAxes grid,
                                  ImageHeader& image, const std::vector<std::uint64_t>& sizes,
                                  const std::string& path) {
  const std::size_t axes = header.sizes.size();
  const auto perAxis = [&](const char* name) -> std::optional<std::vector<double>> {
    const auto numbers = toNumbers(header.field(name));
    if (!numbers || (!numbers->empty() && numbers->size() != axes)) return {};
    return numbers->empty() ? std::vector<double>(axes, std::nan("")) : *numbers;
  };
  const auto spacings = perAxis("spacings"), mins = perAxis("axismins"), maxs = perAxis("axismaxs");
  if (!spacings || !mins || !maxs)
    return Error{path + " has spacings, axis mins or axis maxs that are not one number an axis."};
  const auto centerings = words(lowerCase(header.field("centerings")));
  std::vector<glm::dvec3> steps;
  glm::dvec3 origin(0);
  for (std::size_t n = 0; n < grid.count; ++n) {
    const std::size_t a = grid.first + n;
    const bool cell = a < centerings.size() && centerings[a] == "cell";
    const double intervals = double(sizes[n]) - (cell ? 0 : 1);
    double step = (*spacings)[a];
    if (std::isnan(step) && intervals > 0) step = ((*maxs)[a] - (*mins)[a]) / intervals;
    if (std::isnan(step)) return false;
    const double mm = unitMm(header, "units", a, image.warnings);
    glm::dvec3 along(0);
    along[int(n)] = step * mm;
    steps.push_back(along);
    if (!std::isnan((*mins)[a])) origin[int(n)] = ((*mins)[a] + (cell ? step / 2 : 0)) * mm;
  }
  if (isLeftHanded(space)) {
    for (glm::dvec3& step : steps) step *= space.toLps;
    origin *= space.toLps;
  }
  if (Status s = setGeometry(image, sizes, steps, origin, path); !s) return s.error();
  return true;
}

Status setNrrdGeometry(const NrrdHeader& header, const Space& space,
                       const std::optional<std::vector<Vector>>& directions, GridAxes grid,
                       ImageHeader& image, const std::string& path) {
  const auto begin = header.sizes.begin() + grid.first;
  const std::vector<std::uint64_t> sizes(begin, begin + grid.count);
  if (isLeftHanded(space))
    image.warnings.emplace_back(
        "The header's space is left-handed: its third axis is turned round, so that nothing is mirrored.");
  if (!directions) {
    auto done = geometryFromSpacings(header, space, grid, image, sizes, path);
    if (!done) return done.error();
    if (!*done) return setNominalGeometry(image, sizes, path);
    image.warnings.push_back(
        {"The header gives spacings but no directions: which side is left or top is not known.",
         WarningKind::noDirections});
    return {};
  }
  const double mm = unitMm(header, "spaceunits", 0, image.warnings);
  std::vector<glm::dvec3> steps;
  for (std::size_t n = 0; n < grid.count; ++n)
    steps.push_back(inLps(*(*directions)[grid.first + n], space) * mm);
  glm::dvec3 origin(0);
  if (const std::string text = header.field("spaceorigin"); !text.empty()) {
    const auto vectors = parseVectors(text, space.dimension);
    if (!vectors || vectors->size() != 1 || !(*vectors)[0])
      return Error{path + " has the space origin '" + fieldText(text) + "', which is not one vector."};
    origin = inLps(*(*vectors)[0], space) * mm;
  } else {
    image.warnings.emplace_back("The header gives no position: voxel (0, 0, 0) is taken as the origin.");
  }
  if (!space.anatomical)
    image.warnings.push_back(
        {"The header names no anatomical space: its axes are taken as left, posterior, superior.",
         WarningKind::noDirections});
  return setGeometry(image, sizes, steps, origin, path);
}

}  // namespace

Result<ImageHeader> readNrrdHeader(const std::string& path) {
  auto header = readNrrdFields(path);
  if (!header) return header.error();
  auto space = parseSpace(*header, path);
  if (!space) return space.error();
  const std::size_t axes = header->sizes.size();

  std::optional<std::vector<Vector>> directions;
  if (const std::string text = header->field("spacedirections"); !text.empty()) {
    directions = parseVectors(text, space->dimension);
    if (!directions || directions->size() != axes || space->dimension == 0)
      return Error{path + " has space directions that are not one vector of its space (or none) an axis."};
  }
  auto kinds = words(lowerCase(header->field("kinds")));
  if (!kinds.empty() && kinds.size() != axes)
    return Error{path + " has " + std::to_string(kinds.size()) + " kinds for " + std::to_string(axes) +
                 " axes."};
  kinds.resize(axes);
  auto grid = gridAxes(*header, directions, kinds, path);
  if (!grid) return grid.error();

  ImageHeader image;
  image.format = "NRRD";
  image.description = fieldText(header->field("content"));
  image.data = header->data;
  image.keyValues.assign(header->keyValues.begin(), header->keyValues.end());
  if (Status s = setNrrdGeometry(*header, *space, directions, *grid, image, path); !s) return s.error();
  const auto begin = header->sizes.begin(), inner = begin + grid->first, outer = inner + grid->count;
  if (Status s = setCounts(image.data, {begin, inner}, {inner, outer}, {outer, header->sizes.end()}, path);
      !s)
    return s.error();
  image.names = namesOf(*header, *grid, kinds);
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen
