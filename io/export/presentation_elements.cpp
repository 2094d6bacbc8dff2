#include "io/export/presentation_elements.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "io/dicom/cielab.h"
#include "io/dicom/data_set.h"
#include "io/dicom/units.h"
#include "io/export/dicom_modules.h"
#include "io/export/study_object.h"

namespace volumen {

namespace {

using dicom::vrOf;

void joinValue(std::string& list, const std::string& value) { list += (list.empty() ? "" : "\\") + value; }

std::string wordOf(float share) {
  return std::to_string(std::lround(std::clamp(share, 0.0F, 1.0F) * 65535.0));
}

// Returns the coordinates of points as a value of VR FL.
std::string floatsOf(std::initializer_list<glm::dvec2> points) {
  std::string all;
  for (const glm::dvec2 p : points)
    for (const double x : {p.x, p.y}) {
      char text[32];
      joinValue(all, std::string(text, std::to_chars(text, std::end(text), float(x)).ptr));
    }
  return all;
}

std::string floatsOf(const std::vector<glm::dvec2>& points) {
  std::string all;
  for (const glm::dvec2 p : points) joinValue(all, floatsOf({p}));
  return all;
}

const char* unitsName(AnnotationUnits units) { return units == AnnotationUnits::pixel ? "PIXEL" : "DISPLAY"; }

// Returns the descriptor and the data of a lookup table.
DicomElements lookupTable(const std::vector<std::uint16_t>& entries, double first, int depth) {
  const auto vr = first < 0 ? vrOf('S', 'S') : vrOf('U', 'S');
  std::string data;
  for (const std::uint16_t entry : entries) {
    char text[8];
    joinValue(data, std::string(text, std::to_chars(text, std::end(text), entry, 16).ptr));
  }
  const std::string count = std::to_string(std::int16_t(std::uint16_t(entries.size())));
  const std::string unsignedCount = std::to_string(std::uint16_t(entries.size()));
  return {
      {0x00283002, (first < 0 ? count : unsignedCount) + '\\' + std::to_string(std::lround(first)) + "\\16",
       vr, depth},
      {0x00283006, data, vrOf('O', 'W'), depth}};
}

// Returns greys as 16-bit entries. A presentation state must have these or packed bytes (dciodvfy).
std::vector<std::uint16_t> tableEntries(const std::vector<float>& greys) {
  std::vector<std::uint16_t> entries;
  for (const float grey : greys)
    entries.push_back(std::uint16_t(std::lround(std::clamp(double(grey), 0.0, 1.0) * 65535)));
  return entries;
}

const char* functionName(WindowFunction function) {
  constexpr const char* names[] = {"LINEAR", "LINEAR_EXACT", "SIGMOID"};
  return names[int(function)];
}

// Returns the RescaleType that readers take for this unit.
std::string rescaleTypeOf(const std::string& unit) {
  if (unit.empty()) return "US";
  for (const char* term : {"MGML", "PCT", "OD", "BQML"})
    if (dicom::unitOfRescaleType(term) == unit) return term;
  return inOneLine(unit);
}

}  // namespace

DicomElements PresentationElements::pictureItems(const std::vector<ReferencedPicture>& pictures,
                                                 int depth) const {
  DicomElements all;
  if (!pictures.empty()) all.push_back({0x00081140, {}, 0, depth});
  for (const ReferencedPicture& picture : pictures) {
    const DicomSourceFile& file = *files_.at(picture.sopInstanceUid);
    append(all, {{dicomItem, {}, 0, depth + 1},
                 {0x00081150, file.sopClassUid, 0, depth + 1},
                 {0x00081155, picture.sopInstanceUid, 0, depth + 1}});
    std::string frames;
    for (const int frame : picture.frames) joinValue(frames, std::to_string(frame + 1));
    if (!frames.empty() && file.isMultiFrame()) all.push_back({0x00081160, frames, 0, depth + 1});
  }
  return all;
}

DicomElements PresentationElements::values() const {
  const ValueMapping& values = p_.values;
  if (values.table.empty()) {
    if (values.slope == 1 && values.intercept == 0 && values.unit.empty()) return {};
    return {{0x00281052, decimal(values.intercept)},
            {0x00281053, decimal(values.slope)},
            {0x00281054, rescaleTypeOf(values.unit)}};
  }
  DicomElements all = {
      {0x00283000, {}}, {dicomItem, {}, 0, 1}, {0x00283004, rescaleTypeOf(values.unit), 0, 1}};
  append(all, lookupTable(values.table, values.first, 1));
  return all;
}

DicomElements PresentationElements::greys(const Presentation::Greys& part) {
  std::string centres, widths, names;
  DicomElements tables;
  const GreyMapping* first = nullptr;
  bool isNamed = false;
  for (const NamedGrey& grey : part.greys) {
    const GreyMapping& m = grey.mapping;
    if (!m.table.grey.empty()) {
      append(tables, {{dicomItem, {}, 0, 2}, {0x00283003, inOneLine(grey.name), 0, 2}});
      append(tables, lookupTable(tableEntries(m.table.grey), m.table.first, 2));
      continue;
    }
    if (first && m.function != first->function) {
      notes_.emplace_back("A window is left out: all windows of a presentation state have one function.");
      continue;
    }
    names += (first ? "\\" : "") + inOneLine(grey.name);
    first = &m;
    isNamed = isNamed || !grey.name.empty();
    joinValue(centres, decimal(m.window.centre));
    joinValue(widths, decimal(m.window.width));
  }
  DicomElements all = {{dicomItem, {}, 0, 1}};
  append(all, pictureItems(part.of, 1));
  if (first) {
    append(all, {{0x00281050, centres, 0, 1}, {0x00281051, widths, 0, 1}});
    if (first->function != WindowFunction::linear)
      all.push_back({0x00281056, functionName(first->function), 0, 1});
    if (isNamed) all.push_back({0x00281055, names, 0, 1});
  }
  if (!tables.empty()) all.push_back({0x00283010, {}, 0, 1});
  append(all, tables);
  return all;
}

DicomElements PresentationElements::shutter() {
  using Kind = ShutterShape::Kind;
  DicomElements all;
  std::string names;
  const auto whole = [](double x) { return std::to_string(std::lround(x)); };
  std::set<Kind> known;
  for (const ShutterShape& shape : p_.shutter.shapes) {
    if (!known.insert(shape.kind).second) {
      notes_.emplace_back("A shutter is left out: a presentation state has one of each shape.");
      continue;
    }
    if (shape.kind == Kind::rectangle) {
      joinValue(names, "RECTANGULAR");
      append(all, {{0x00181602, whole(shape.from.x)},
                   {0x00181604, whole(shape.to.x)},
                   {0x00181606, whole(shape.from.y)},
                   {0x00181608, whole(shape.to.y)}});
    } else if (shape.kind == Kind::circle) {
      joinValue(names, "CIRCULAR");
      append(all, {{0x00181610, whole(shape.centre.y) + '\\' + whole(shape.centre.x)},
                   {0x00181612, whole(std::max(1.0, shape.radius))}});
    } else {
      joinValue(names, "POLYGONAL");
      std::string corners;
      for (const glm::dvec2 corner : shape.corners) {
        joinValue(corners, whole(corner.y));
        joinValue(corners, whole(corner.x));
      }
      all.push_back({0x00181620, corners});
    }
  }
  if (!names.empty()) append(all, {{0x00181600, names}, {0x00181622, wordOf(p_.shutter.grey)}});
  return all;
}

// The corners of the area are those on screen, after the turn (C.10.4), counted from 1.
DicomElements PresentationElements::area(const Presentation::Area& part) const {
  const PresentedGrid grid({.turn = p_.turn, .area = part.area, .layers = {}, .graphics = {}, .texts = {}},
                           frame_.size);
  const auto text = [](glm::ivec2 pixel) {
    return std::to_string(pixel.x + 1) + '\\' + std::to_string(pixel.y + 1);
  };
  DicomElements all = {{dicomItem, {}, 0, 1}};
  append(all, pictureItems(part.of, 1));
  append(all, {{0x00700052, text(grid.pixelAt({0, 0})), 0, 1},
               {0x00700053, text(grid.pixelAt(grid.size() - 1)), 0, 1},
               {0x00700100, "SCALE TO FIT", 0, 1}});
  const PixelSize& pixel = frame_.pixel;
  if (pixel.kind == PixelSizeKind::patient || pixel.kind == PixelSizeKind::calibrated) {
    all.push_back({0x00700101, decimals({pixel.mm.y, pixel.mm.x}), 0, 1});
    return all;
  }
  constexpr long parts = 1000;
  const long high = std::max(1L, std::lround(parts * pixel.mm.y / pixel.mm.x)),
             common = std::gcd(high, parts);
  all.push_back({0x00700102, std::to_string(high / common) + '\\' + std::to_string(parts / common), 0, 1});
  return all;
}

// Returns a layer name of its own: at most 16 capital letters, digits, blanks and underscores (VR CS).
std::string PresentationElements::layerName(const std::string& name) {
  constexpr std::size_t longest = 16;
  const auto known = layerNames_.find(name);
  if (known != layerNames_.end()) return known->second;
  std::string term;
  for (const char c : name.substr(0, longest)) {
    const bool isLetter = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' || c == '_';
    term += isLetter ? c : c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : '_';
  }
  const auto isTaken = [&](const std::string& text) {
    return text.find_first_not_of(' ') == std::string::npos ||
           std::ranges::any_of(layerNames_, [&](const auto& one) { return one.second == text; });
  };
  for (int n = 1; isTaken(term); ++n) term = "LAYER" + std::to_string(n);
  layerNames_[name] = term;
  return term;
}

DicomElements PresentationElements::layers() {
  std::vector<GraphicLayer> all = p_.layers;
  const auto addMissing = [&](const std::string& name) {
    if (std::ranges::find(all, name, &GraphicLayer::name) == all.end())
      all.push_back({.name = name, .description = {}, .colour = {}});
  };
  for (const auto& part : p_.annotations) {
    for (const Graphic& graphic : part.graphics) addMissing(graphic.layer);
    for (const GraphicText& text : part.texts) addMissing(text.layer);
  }
  DicomElements elements;
  if (!all.empty()) elements.push_back({0x00700060, {}});
  for (std::size_t n = 0; n < all.size(); ++n) {
    const GraphicLayer& layer = all[n];
    append(elements, {{dicomItem, {}, 0, 1},
                      {0x00700002, layerName(layer.name), 0, 1},
                      {0x00700062, std::to_string(n + 1), 0, 1},
                      {0x00700066, wordOf(layer.grey), 0, 1}});
    if (!layer.description.empty()) elements.push_back({0x00700068, inOneLine(layer.description), 0, 1});
    if (!layer.colour) continue;
    const auto lab = dicom::cieLabOf(*layer.colour);
    elements.push_back(
        {0x00700401, std::to_string(lab[0]) + '\\' + std::to_string(lab[1]) + '\\' + std::to_string(lab[2]),
         0, 1});
  }
  return elements;
}

DicomElements PresentationElements::graphic(const Graphic& graphic) {
  constexpr const char* names[] = {"POINT", "POLYLINE", "INTERPOLATED", "CIRCLE", "ELLIPSE"};
  constexpr std::size_t mostPoints = 65535;  // the largest value of VR US
  if (graphic.points.size() > mostPoints) {
    notes_.emplace_back("A shape is left out: it has more than 65535 points.");
    return {};
  }
  return {{dicomItem, {}, 0, 2},
          {0x00700005, unitsName(graphic.units), 0, 2},
          {0x00700020, "2", 0, 2},
          {0x00700021, std::to_string(graphic.points.size()), 0, 2},
          {0x00700022, floatsOf(graphic.points), 0, 2},
          {0x00700023, names[int(graphic.type)], 0, 2},
          {0x00700024, graphic.filled ? "Y" : "N", 0, 2}};
}

namespace {

DicomElements textElements(const GraphicText& text) {
  constexpr const char* justified[] = {"LEFT", "CENTER", "RIGHT"};
  DicomElements all = {{dicomItem, {}, 0, 2}};
  if (text.box)
    append(all, {{0x00700003, unitsName(text.box->units), 0, 2},
                 {0x00700010, floatsOf({text.box->topLeft}), 0, 2},
                 {0x00700011, floatsOf({text.box->bottomRight}), 0, 2},
                 {0x00700012, justified[int(text.box->justified)], 0, 2}});
  if (text.anchor)
    append(all, {{0x00700004, unitsName(text.anchor->units), 0, 2},
                 {0x00700014, floatsOf({text.anchor->point}), 0, 2},
                 {0x00700015, text.anchor->visible ? "Y" : "N", 0, 2}});
  all.push_back({0x00700006, text.text, 0, 2});
  return all;
}

// Returns the layers of a part in the order of their first use.
std::vector<std::string> layersOf(const Presentation::Annotations& part) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const Graphic& graphic : part.graphics) add(graphic.layer);
  for (const GraphicText& text : part.texts) add(text.layer);
  return names;
}

}  // namespace

// Writes an item for each layer, as an item can only name one.
DicomElements PresentationElements::annotations(const Presentation::Annotations& part) {
  constexpr std::size_t longestText = 1024;  // characters, in VR ST
  DicomElements all;
  for (const std::string& layer : layersOf(part)) {
    DicomElements graphics, texts;
    for (const Graphic& one : part.graphics)
      if (one.layer == layer) append(graphics, graphic(one));
    for (GraphicText text : part.texts) {
      if (text.layer != layer) continue;
      if (text.text.empty() || (!text.box && !text.anchor)) {
        notes_.emplace_back("A text is left out: it is empty or has no place.");
        continue;
      }
      const std::string whole = std::exchange(text.text, firstCharacters(text.text, longestText));
      if (text.text.size() < whole.size()) notes_.emplace_back("A text is cut after 1024 characters.");
      append(texts, textElements(text));
    }
    if (graphics.empty() && texts.empty()) continue;
    all.push_back({dicomItem, {}, 0, 1});
    append(all, pictureItems(part.of, 1));
    all.push_back({0x00700002, layerName(layer), 0, 1});
    if (!texts.empty()) all.push_back({0x00700008, {}, 0, 1});
    append(all, texts);
    if (!graphics.empty()) all.push_back({0x00700009, {}, 0, 1});
    append(all, graphics);
  }
  return all;
}

DicomElements PresentationElements::all(const std::vector<ReferencedPicture>& pictures,
                                        const std::string& seriesUid) {
  DicomElements all = {{0x00081115, {}}, {dicomItem, {}, 0, 1}, {0x0020000e, seriesUid, 0, 1}};
  append(all, pictureItems(pictures, 1));
  append(all, values());
  if (!p_.greys.empty()) all.push_back({0x00283110, {}});
  for (const Presentation::Greys& part : p_.greys) append(all, greys(part));
  append(all, shutter());
  append(all, {{0x20500020, p_.inverted ? "INVERSE" : "IDENTITY"},
               {0x00700041, p_.turn.mirrored ? "Y" : "N"},
               {0x00700042, std::to_string(90 * p_.turn.quarters)},
               {0x0070005a, {}}});
  for (const Presentation::Area& part : p_.areas) append(all, area(part));
  if (p_.areas.empty()) append(all, area({{}, {{0, 0}, frame_.size - 1}}));
  append(all, layers());
  DicomElements drawn;
  for (const Presentation::Annotations& part : p_.annotations) append(drawn, annotations(part));
  if (!drawn.empty()) all.push_back({0x00700001, {}});
  append(all, drawn);
  return all;
}

}  // namespace volumen
