#pragma once

#include <QLabel>

#include "tests/ui/import_window.h"

namespace volumen::tests {

inline bool isBallAboutHollow(glm::dvec3 p) { return glm::length(p + 5.0) < 10; }
inline bool isLow(glm::dvec3 p) { return p.z < -5; }

/// Imports two maps. Map 1 is "Ball": all within 10 mm of the centre of the hollow ball. Map 2 is "Low": the
/// lower part of the volume.
struct OverlapWindow : ImportWindow {
  Segmented layer(const char* name, glm::u8vec3 colour, bool (*isIn)(glm::dvec3)) {
    return {{{.number = 1, .label = name, .colour = colour}}, labelsBy(isIn)};
  }
  bool importBoth() {
    const std::vector<Segmented> layers{layer("Ball", {255, 0, 0}, isBallAboutHollow),
                                        layer("Low", {0, 255, 0}, isLow)};
    return writeSegNrrd(layers, at("both.seg.nrrd").toStdString()) && import(at("both.seg.nrrd"));
  }
  const SegmentMap& mapOf(int number) { return *segmentMapOf(workspace(), series(), number); }
  BitMask maskIn(int number) { return maskOf(*mapOf(number).labels, 1); }
  /// Returns the text about the active map.
  QString worked() {
    const auto* label = child<QLabel>("segmentMap");
    return label->isVisible() ? label->text() : QString();
  }
  QString cell(int row, int column) { return list()->topLevelItem(row)->text(column); }
};

}  // namespace volumen::tests
