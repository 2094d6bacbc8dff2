#include "io/presentation.h"

#include <algorithm>

#include "io/dicom/cielab.h"
#include "io/dicom/derived_object.h"
#include "io/dicom/greys.h"
#include "io/dicom/isolated_file.h"
#include "io/dicom/shutter.h"
#include "io/dicom/units.h"
#include "io/worker/object_fields.h"

namespace volumen {
namespace dicom {
namespace {

using Scope = DataSet::Scope;

constexpr const char* grayscaleClasses[] = {"1.2.840.10008.5.1.4.1.1.11.1", "1.2.840.10008.5.1.4.1.1.11.5"};
constexpr std::size_t mostPoints = 1'000'000;

/// Reads a presentation state.
class PresentationReader {
 public:
  explicit PresentationReader(const DataSet& data) : data_(data) {}

  Result<Presentation> run(const DerivedObject& object) {
    out_.label = object.label;
    out_.description = object.text;
    out_.creator = data_.utf8(0x00700084, data_.root());
    out_.date = object.date;
    out_.pictures = object.pictures;
    if (Status s = readValues(); !s) return s.error();
    readGreys();
    readLut();
    out_.shutter = readShutter(data_, FrameScopes(data_.root()), out_.warnings);
    readTurn();
    readAreas();
    readLayers();
    for (const Scope item : data_.items(0x00700001, data_.root())) readAnnotations(item);
    return std::move(out_);
  }

 private:
  void leaveOut(const std::string& what) { out_.warnings.push_back(what + "."); }

  std::vector<ReferencedPicture> picturesOf(Scope item) const {
    return readPictures(data_, data_.contents(0x00081140, item));
  }

  Status readValues() {
    const Scope root = data_.root();
    for (const auto& [tag, value] :
         {std::pair(0x00281053u, &out_.values.slope), {0x00281052u, &out_.values.intercept}}) {
      if (!data_.has(tag, root)) continue;
      const auto number = data_.number(tag, root);
      if (!number) return Error{"its rescale " + tagText(tag) + " is no number"};
      *value = *number;
    }
    if (out_.values.slope == 0) return Error{"its RescaleSlope is 0"};
    out_.values.unit = unitOfRescaleType(data_.utf8(0x00281054, root));
    return readModalityLut(data_, false, out_.values);
  }

  void readGreys() {
    const bool signedInput = out_.values.table.empty() && out_.values.intercept < 0;
    for (const Scope item : data_.items(0x00283110, data_.root())) {
      Presentation::Greys part{picturesOf(item), readMappings(data_, item, signedInput, out_.warnings)};
      if (!part.greys.empty()) out_.greys.push_back(std::move(part));
    }
  }

  void readLut() {
    out_.inverted = isInverse(data_);
    if (data_.has(0x20500010, data_.root())) leaveOut("Its Presentation LUT Sequence is not applied");
  }

  void readTurn() {
    const int degrees = data_.word(0x00700042, data_.root()).value_or(0);
    if (degrees % 90 == 0 && degrees < 360)
      out_.turn.quarters = degrees / 90;
    else
      leaveOut("Its rotation by " + std::to_string(degrees) + " degrees is not applied");
    out_.turn.mirrored = data_.text(0x00700041, data_.root()) == "Y";
  }

  void readAreas() {
    for (const Scope item : data_.items(0x0070005a, data_.root())) {
      const auto a = data_.longs(0x00700052, item), b = data_.longs(0x00700053, item);
      constexpr std::int32_t farthest = 1 << 24;
      const auto isNear = [](std::int32_t x) { return x > -farthest && x < farthest; };
      if (a.size() < 2 || b.size() < 2 || !isNear(a[0]) || !isNear(a[1]) || !isNear(b[0]) || !isNear(b[1])) {
        leaveOut("A displayed area without two corners near the picture is not applied");
        continue;
      }
      // The corners are those on screen. In a turned picture they are any two opposite ones.
      const glm::ivec2 first(a[0] - 1, a[1] - 1), second(b[0] - 1, b[1] - 1);
      out_.areas.push_back({picturesOf(item), {glm::min(first, second), glm::max(first, second)}});
    }
  }

  void readLayers() {
    for (const Scope item : data_.items(0x00700060, data_.root())) {
      GraphicLayer layer;
      layer.name = data_.utf8(0x00700002, item);
      layer.description = data_.utf8(0x00700068, item);
      layer.order = data_.number(0x00700062, item).value_or(0);
      layer.grey = float(data_.word(0x00700066, item).value_or(65535) / 65535.0);
      layer.colour = readCieLab(data_, 0x00700401, item);
      out_.layers.push_back(std::move(layer));
    }
    std::ranges::stable_sort(out_.layers, {}, &GraphicLayer::order);
  }

  void readAnnotations(Scope item) {
    Presentation::Annotations part{picturesOf(item), {}, {}};
    const std::string layer = data_.utf8(0x00700002, item);
    for (const Scope object : data_.items(0x00700009, item))
      if (auto graphic = readGraphic(object, layer)) part.graphics.push_back(std::move(*graphic));
    for (const Scope object : data_.items(0x00700008, item))
      if (auto text = readText(object, layer)) part.texts.push_back(std::move(*text));
    out_.annotations.push_back(std::move(part));
  }

  std::optional<AnnotationUnits> unitsAt(std::uint32_t tag, Scope item) const {
    const std::string name = data_.text(tag, item);
    if (name == "PIXEL") return AnnotationUnits::pixel;
    if (name == "DISPLAY") return AnnotationUnits::display;
    return {};
  }

  /// Returns pairs of finite numbers, or none if any number is not finite.
  std::vector<glm::dvec2> pointsAt(std::uint32_t tag, Scope item) const {
    const std::vector<float> numbers = data_.floats(tag, item);
    std::vector<glm::dvec2> points;
    if (numbers.size() % 2 == 1 || numbers.size() > 2 * mostPoints) return points;
    for (std::size_t n = 0; n < numbers.size(); n += 2) {
      if (!std::isfinite(numbers[n]) || !std::isfinite(numbers[n + 1])) return {};
      points.emplace_back(numbers[n], numbers[n + 1]);
    }
    return points;
  }

  std::optional<Graphic> readGraphic(Scope item, const std::string& layer) {
    struct Rule {
      const char* name;
      GraphicType type;
      std::size_t least, most;
    };
    constexpr Rule rules[] = {{"POINT", GraphicType::point, 1, 1},
                              {"POLYLINE", GraphicType::polyline, 2, mostPoints},
                              {"INTERPOLATED", GraphicType::interpolated, 2, mostPoints},
                              {"CIRCLE", GraphicType::circle, 2, 2},
                              {"ELLIPSE", GraphicType::ellipse, 4, 4}};
    const std::string name = data_.text(0x00700023, item);
    const auto* rule = std::ranges::find(rules, name, &Rule::name);
    const auto units = unitsAt(0x00700005, item);
    Graphic graphic{{}, units.value_or(AnnotationUnits::pixel), pointsAt(0x00700022, item), false, layer};
    const std::size_t count = graphic.points.size();
    if (rule == std::end(rules) || !units || count < rule->least || count > rule->most) {
      leaveOut("A graphic \"" + toUtf8(name, {}) + "\" with " + std::to_string(count) +
               " points is left out: its type, units or number of points are not those of the standard");
      return {};
    }
    graphic.type = rule->type;
    graphic.filled = data_.text(0x00700024, item) == "Y";
    return graphic;
  }

  std::optional<GraphicText::Box> readBox(Scope item) const {
    const auto units = unitsAt(0x00700003, item);
    const auto a = pointsAt(0x00700010, item), b = pointsAt(0x00700011, item);
    if (!units || a.size() != 1 || b.size() != 1) return {};
    using Justified = GraphicText::Box::Justified;
    const std::string how = data_.text(0x00700012, item);
    return GraphicText::Box{a[0], b[0], *units,
                            how == "RIGHT"    ? Justified::right
                            : how == "CENTER" ? Justified::centre
                                              : Justified::left};
  }

  std::optional<GraphicText::Anchor> readAnchor(Scope item) const {
    const auto units = unitsAt(0x00700004, item);
    const auto point = pointsAt(0x00700014, item);
    if (!units || point.size() != 1) return {};
    return GraphicText::Anchor{point[0], *units, data_.text(0x00700015, item) == "Y"};
  }

  std::optional<GraphicText> readText(Scope item, const std::string& layer) {
    GraphicText text{data_.utf8(0x00700006, item), readBox(item), readAnchor(item), layer};
    if (text.box || text.anchor) return text;
    leaveOut("A text is left out: it has neither a box nor an anchor");
    return {};
  }

  const DataSet& data_;
  Presentation out_;
};

}  // namespace
}  // namespace dicom

namespace {

Result<Presentation> loadPresentationHere(const std::string& path) {
  constexpr auto kind = DerivedKind::presentation;
  return dicom::loadObject<Presentation>(
      path, kind, [](const dicom::InspectedFile& file, const dicom::DataSet& data) -> Result<Presentation> {
        const DerivedObject& object = *file.found.derivedObject;
        if (std::ranges::find(dicom::grayscaleClasses, object.sopClassUid) ==
            std::end(dicom::grayscaleClasses))
          return Error{"only grayscale presentation states are read; this one is of another kind"};
        return dicom::PresentationReader(data).run(object);
      });
}

}  // namespace

Result<Presentation> loadPresentation(const std::string& path) {
  return dicom::isolatedFile<loadPresentationHere>(path, 0);
}

}  // namespace volumen
