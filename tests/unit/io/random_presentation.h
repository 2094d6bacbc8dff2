#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "io/presentation.h"
#include "io/study/series.h"
#include "tests/fixtures/chance.h"

namespace volumen::tests {

/// Writes a presentation as text, all of it but its date.
class Told {
 public:
  std::string of(const Presentation& p) {
    add("label", p.label, p.description, p.creator);
    pictures(p.pictures, true);
    add("values", p.values.slope, p.values.intercept, p.values.first, p.values.table.size(), p.values.unit);
    for (const std::uint16_t entry : p.values.table) add(entry);
    for (const auto& part : p.greys) {
      pictures(part.of, false);
      for (const NamedGrey& grey : part.greys) told(grey);
    }
    add("inverted", p.inverted, "turn", p.turn.quarters, p.turn.mirrored);
    add("shutter", p.shutter.grey);
    for (const ShutterShape& s : p.shutter.shapes) {
      add(int(s.kind), s.from.x, s.from.y, s.to.x, s.to.y, s.centre.x, s.centre.y, s.radius);
      for (const glm::dvec2 c : s.corners) add(c.x, c.y);
    }
    for (const auto& part : p.areas) {
      pictures(part.of, false);
      add("area", part.area.from.x, part.area.from.y, part.area.to.x, part.area.to.y);
    }
    for (const GraphicLayer& layer : p.layers) {
      add("layer", layer.name, layer.description, layer.order, layer.grey);
      if (layer.colour) add(int(layer.colour->r), int(layer.colour->g), int(layer.colour->b));
    }
    for (const auto& part : p.annotations) told(part);
    for (const std::string& warning : p.warnings) add("warning", warning);
    return text_;
  }

 private:
  void one(const std::string& value) { text_ += " " + value; }
  void one(const char* value) { text_ += std::string(" ") + value; }
  void one(double value) {
    char text[32];
    std::snprintf(text, sizeof text, " %.9g", value);
    text_ += text;
  }
  template <class... Value>
  void add(const Value&... values) {
    text_ += "\n";
    (one(values), ...);
  }
  void pictures(const std::vector<ReferencedPicture>& all, bool inSeries) {
    for (const ReferencedPicture& picture : all) {
      add("picture", picture.sopInstanceUid, inSeries ? picture.seriesUid : "");
      for (const int frame : picture.frames) add(frame);
    }
  }
  void told(const NamedGrey& grey) {
    const GreyMapping& m = grey.mapping;
    add("grey", grey.name, m.window.centre, m.window.width, int(m.function), m.table.first,
        m.table.grey.size());
    for (const float g : m.table.grey) add(g);
  }
  void told(const Presentation::Annotations& part) {
    pictures(part.of, false);
    for (const Graphic& g : part.graphics) {
      add("graphic", int(g.type), int(g.units), g.filled, g.layer);
      for (const glm::dvec2 point : g.points) add(point.x, point.y);
    }
    for (const GraphicText& t : part.texts) {
      add("text", t.text, t.layer);
      if (t.box)
        add("box", t.box->topLeft.x, t.box->topLeft.y, t.box->bottomRight.x, t.box->bottomRight.y,
            int(t.box->units), int(t.box->justified));
      if (t.anchor)
        add("anchor", t.anchor->point.x, t.anchor->point.y, int(t.anchor->units), t.anchor->visible);
    }
  }
  std::string text_;
};

inline glm::dvec2 randomPoint(Chance& chance) {
  return {double(float(chance.between(-3, 12))), double(float(chance.between(0, 9)))};
}

inline NamedGrey randomTable(Chance& chance) {
  NamedGrey grey{"table " + std::to_string(chance.below(9)), {}};
  const int bits = chance.oneIn(3) ? 8 : 16, count = 1 + chance.below(300);
  GreyTable& table = grey.mapping.table;
  table.first = chance.below(200);
  for (int n = 0; n < count; ++n)
    table.grey.push_back(float(chance.below(1 << bits) / double((1 << bits) - 1)));
  table.grey.push_back(1);
  grey.mapping.window = {table.first + double(table.grey.size()) / 2, double(table.grey.size())};
  return grey;
}

inline Presentation::Greys randomGreys(Chance& chance) {
  Presentation::Greys part;
  const auto function = WindowFunction(chance.below(3));
  const bool isNamed = chance.oneIn(2);
  for (int n = 1 + chance.below(3); n > 0; --n)
    part.greys.push_back(
        {isNamed ? "window " + std::to_string(n) : "",
         {{chance.below(2000) / 8.0 - 100, 1 + chance.below(4000) / 8.0}, function, {}, false}});
  for (int n = chance.below(3); n > 0; --n) part.greys.push_back(randomTable(chance));
  return part;
}

inline Shutter randomShutter(Chance& chance) {
  Shutter shutter;
  shutter.grey = float(chance.below(65536) / 65535.0);
  if (chance.oneIn(2)) {
    ShutterShape box;
    box.from = {1 + chance.below(3), 1 + chance.below(3)};
    box.to = {5 + chance.below(3), 5 + chance.below(3)};
    shutter.shapes.push_back(box);
  }
  if (chance.oneIn(2)) {
    ShutterShape circle;
    circle.kind = ShutterShape::Kind::circle;
    circle.centre = {chance.below(8), chance.below(8)};
    circle.radius = 1 + chance.below(8);
    shutter.shapes.push_back(circle);
  }
  if (chance.oneIn(2)) {
    ShutterShape polygon;
    polygon.kind = ShutterShape::Kind::polygon;
    for (int n = 0; n < 3 + chance.below(5); ++n)
      polygon.corners.emplace_back(chance.below(9), chance.below(9));
    while (polygon.corners.size() < 3) polygon.corners.emplace_back(1, 2);
    shutter.shapes.push_back(polygon);
  }
  if (shutter.shapes.empty()) shutter.grey = 0;  // said only of a shutter that is there
  return shutter;
}

inline Graphic randomGraphic(const std::string& layer, Chance& chance) {
  Graphic graphic{GraphicType(chance.below(5)), AnnotationUnits(chance.below(2)), {}, chance.oneIn(2), layer};
  const std::size_t counts[] = {1, std::size_t(2 + chance.below(40)), std::size_t(2 + chance.below(9)), 2, 4};
  for (std::size_t n = 0; n < counts[int(graphic.type)]; ++n) graphic.points.push_back(randomPoint(chance));
  return graphic;
}

inline GraphicText randomText(const std::string& layer, Chance& chance) {
  static const char* const words[] = {"12.3 mm", "two\r\nlines", "a \\ b",
                                      "Gr\xc3\xb6\xc3\x9f"
                                      "e 3 cm\xc2\xb2"};
  GraphicText text{words[chance.below(4)], {}, {}, layer};
  const auto units = AnnotationUnits(chance.below(2));
  const bool hasBox = chance.oneIn(2);
  if (hasBox)
    text.box = GraphicText::Box{randomPoint(chance), randomPoint(chance), units,
                                GraphicText::Box::Justified(chance.below(3))};
  if (!hasBox || chance.oneIn(2))
    text.anchor = GraphicText::Anchor{randomPoint(chance), units, chance.oneIn(2)};
  return text;
}

inline void addAnnotations(Presentation& p, Chance& chance, const std::vector<ReferencedPicture>& of) {
  const std::string names[] = {"MEASURES", "TEXTS 2", "A_B"};
  for (int n = 1 + chance.below(3); n > 0; --n) {
    GraphicLayer layer{names[n - 1],
                       chance.oneIn(2) ? "what was measured" : "",
                       double(p.layers.size() + 1),
                       float(chance.below(65536) / 65535.0),
                       {}};
    if (chance.oneIn(2)) layer.colour = glm::u8vec3(chance.below(256), chance.below(256), chance.below(256));
    p.layers.push_back(layer);
    Presentation::Annotations part{chance.oneIn(2) ? of : std::vector<ReferencedPicture>(), {}, {}};
    for (int more = chance.below(4); more > 0; --more)
      part.graphics.push_back(randomGraphic(layer.name, chance));
    for (int more = chance.below(3); more > 0; --more) part.texts.push_back(randomText(layer.name, chance));
    if (!part.graphics.empty() || !part.texts.empty()) p.annotations.push_back(part);
  }
}

/// Returns a presentation of some slices of a series whose pictures are 8 x 8 pixels.
inline Presentation randomPresentation(const Series& series, Chance& chance) {
  Presentation p;
  p.label = "LABEL " + std::to_string(chance.below(99));
  p.description = "as it was shown";
  p.creator = chance.oneIn(2) ? "Doe^Jane" : "";
  const auto picture = [&](std::size_t n) {
    return ReferencedPicture{series.sopInstanceUids[n], series.seriesUid, {}, {}};
  };
  p.pictures.push_back(picture(std::size_t(chance.below(3))));
  if (chance.oneIn(2)) p.pictures = {picture(0), picture(1), picture(2)};
  std::vector<ReferencedPicture> first{p.pictures[0]};
  if (chance.oneIn(3)) {
    p.values.first = chance.below(2) * -10;
    for (int n = 0; n < 4; ++n) p.values.table.push_back(std::uint16_t(chance.below(65536)));
    // A modality LUT has 8 or 16 bits (PS3.3 C.11.1.1.1); dciodvfy wants the highest bit in one of its
    // values.
    p.values.table.push_back(std::uint16_t(32768 + chance.below(32768)));
  } else if (chance.oneIn(2)) {
    p.values = {chance.oneIn(2) ? 2.5 : 1,
                double(chance.below(2000) - 1024),
                0,
                {},
                chance.oneIn(2) ? "HU" : "Bq/ml"};
  }
  for (int n = chance.below(3); n > 0; --n) p.greys.push_back(randomGreys(chance));
  if (p.greys.size() > 1) p.greys[0].of = first;
  p.inverted = chance.oneIn(2);
  p.turn = {chance.below(4), chance.oneIn(2)};
  p.shutter = randomShutter(chance);
  for (int n = 1 + chance.below(2); n > 0; --n) {
    const glm::ivec2 from(chance.below(6) - 2, chance.below(6) - 2);
    p.areas.push_back({n > 1 ? first : std::vector<ReferencedPicture>(),
                       {from, from + glm::ivec2(chance.below(9), chance.below(9))}});
  }
  addAnnotations(p, chance, first);
  return p;
}

}  // namespace volumen::tests
