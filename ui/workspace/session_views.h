#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "ui/workspace/session_fields.h"
#include "ui/workspace/session_words.h"
#include "ui/workspace/workspace.h"

namespace volumen {

// Lists of the fields of views and their links in sessions (session_fields.h), used by session_json.cpp.

inline void directions(SessionFields& f, glm::dvec3& right, glm::dvec3& down) {
  constexpr double within = 1e-6;
  constexpr Limits cosines{-1 - within, 1 + within};
  f("right", right, cosines);
  f("down", down, cosines);
  f.require("right",
            std::abs(glm::length(right) - 1) < within && std::abs(glm::length(down) - 1) < within &&
                std::abs(glm::dot(right, down)) < within,
            "and down must be orthogonal unit vectors");
}

inline void fields(SessionFields& f, PictureTurn& turn) {
  f("quarters", turn.quarters, {0, 3});
  f("mirrored", turn.mirrored);
}

inline void fields(SessionFields& f, FlatLook& look) {
  f("panMm", look.panMm, mmLimits);
  f("zoom", look.zoom, {1e-3, 1e4});
  f("turn", look.turn);
  f("slabMm", look.slabMm, {0, 1e6});
  f("slabMode", look.slabMode, slabWords);
  f("nearest", look.nearest);
  f("inverted", look.inverted);
  f("frame", look.frame, {0, 1e9});
  f("layers", look.layers);
  f("overlay", look.overlay);
  f("overlayColours", look.overlayColours, colourWords);
  f("overlayOpacity", look.overlayOpacity, {0, 1});
  f("presentation", look.presentation);
  f.unlessNone("windowAlone", look.windowAlone);
}

inline void fields(SessionFields& f, PlaneDirections& plane) { directions(f, plane.right, plane.down); }

inline void fields(SessionFields& f, Crosshair& crosshair) {
  f("at", crosshair.at, mmLimits);
  f("axial", crosshair.axial);
  f("coronal", crosshair.coronal);
  f("sagittal", crosshair.sagittal);
  f("byHand", crosshair.byHand);
  crosshair.byHand = crosshair.byHand || crosshair.turned();  // older sessions lack this field
}

inline void crosshairsField(SessionFields& f, SharedMap<std::string, Crosshair>& crosshairs) {
  mapField(f, "crosshairs", crosshairs, [](SessionFields& item, std::string& frame, Crosshair& crosshair) {
    frameField(item, "frame", frame);
    fields(item, crosshair);
  });
}

inline void fields(SessionFields& f, Rigid& rigid) {
  constexpr double within = 1e-6;
  constexpr Limits parts{-1 - within, 1 + within};
  f("right", rigid.rotation[0], parts);
  f("back", rigid.rotation[1], parts);
  f("up", rigid.rotation[2], parts);
  f("shift", rigid.translation, mmLimits);
  const glm::dmat3 unity = glm::transpose(rigid.rotation) * rigid.rotation;
  double off = std::abs(glm::determinant(rigid.rotation) - 1);
  for (int n = 0; n < 3; ++n) off = std::max(off, glm::length(unity[n] - glm::dmat3(1)[n]));
  f.require("right", off < within, "with back and up must be a rotation");
}

inline void fields(SessionFields& f, FrameLink& link) {
  frameField(f, "from", link.from);
  frameField(f, "to", link.to);
  f("toFromFrom", link.toFromFrom);
  f("registered", link.registered);
}

inline void fields(SessionFields& f, Links& links) {
  f("scroll", links.scroll);
  f("zoom", links.zoom);
  f("pan", links.pan);
  f("window", links.window);
}

inline void fields(SessionFields& f, ViewState& v) {
  f("kind", v.kind, kindWords);
  f("series", v.series);
  mapField(f, "scenes", v.scenes, [](SessionFields& item, SeriesKey& series, SceneLook& look) {
    item("series", series);
    item("scene", look.scene);
    item("preset", look.preset);
  });
  mapField(f, "flats", v.flats, [](SessionFields& item, SeriesKey& series, FlatLook& look) {
    item("series", series);
    fields(item, look);
  });
  crosshairsField(f, v.crosshairs);
  f.unless({}, "wanted", v.wanted);
}

}  // namespace volumen
