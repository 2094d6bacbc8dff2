#pragma once

#include "io/contours.h"
#include "io/dicom/attribute_list.h"
#include "io/presentation.h"
#include "io/report.h"
#include "io/segmentation.h"
#include "io/worker/study_fields.h"
#include "viewer/slice/frame.h"

// How frames as acquired, and objects that refer to pictures, are sent to and from workers.
namespace volumen::worker {

template <>
inline constexpr WindowFunction lastOf<WindowFunction> = WindowFunction::sigmoid;
template <>
inline constexpr PixelSizeKind lastOf<PixelSizeKind> = PixelSizeKind::filmScan;
template <>
inline constexpr ShutterShape::Kind lastOf<ShutterShape::Kind> = ShutterShape::Kind::polygon;
template <>
inline constexpr AnnotationUnits lastOf<AnnotationUnits> = AnnotationUnits::display;
template <>
inline constexpr GraphicType lastOf<GraphicType> = GraphicType::ellipse;
template <>
inline constexpr GraphicText::Box::Justified lastOf<GraphicText::Box::Justified> =
    GraphicText::Box::Justified::right;
template <>
inline constexpr ReportShape::Type lastOf<ReportShape::Type> = ReportShape::Type::ellipsoid;
template <>
inline constexpr Contour::Type lastOf<Contour::Type> = Contour::Type::closedPlanarXor;
template <>
inline constexpr SegmentAlgorithm lastOf<SegmentAlgorithm> = SegmentAlgorithm::automatic;

inline void fields(Wire& w, GreyTable& t) { w(t.first, t.grey); }
inline void fields(Wire& w, GreyMapping& m) { w(m.window, m.function, m.table, m.inverted); }
inline void fields(Wire& w, NamedGrey& g) { w(g.name, g.mapping, g.ofValues); }
inline void fields(Wire& w, PixelSize& p) { w(p.mm, p.kind); }
inline void fields(Wire& w, FrameOverlay& o) { w(o.label, o.mask); }
inline void fields(Wire& w, UltrasoundRegion& r) {
  w(r.from, r.to, r.unitX, r.unitY, r.delta, r.zero, r.sign);
}
inline void fields(Wire& w, FramePlace& p) { w(p.origin, p.row, p.column); }
inline void fields(Wire& w, PixelValues& v) { w(v.stored, v.slope, v.intercept); }
inline void fields(Wire& w, ValueMapping& m) { w(m.slope, m.intercept, m.first, m.table, m.unit); }
inline void fields(Wire& w, Frame& f) {
  w(f.size, f.values, f.mapping, f.rgb, f.greys, f.padding, f.pixel, f.place, f.rowSide, f.columnSide,
    f.overlays, f.shutter, f.shutterGrey, f.regions, f.unit, f.warnings);
}

inline void fields(Wire& w, ShutterShape& s) { w(s.kind, s.from, s.to, s.centre, s.radius, s.corners); }
inline void fields(Wire& w, Shutter& s) { w(s.shapes, s.grey); }
inline void fields(Wire& w, PictureTurn& t) { w(t.quarters, t.mirrored); }
inline void fields(Wire& w, PixelBox& b) { w(b.from, b.to); }
inline void fields(Wire& w, GraphicLayer& l) { w(l.name, l.description, l.order, l.grey, l.colour); }
inline void fields(Wire& w, Graphic& g) { w(g.type, g.units, g.points, g.filled, g.layer); }
inline void fields(Wire& w, GraphicText::Box& b) { w(b.topLeft, b.bottomRight, b.units, b.justified); }
inline void fields(Wire& w, GraphicText::Anchor& a) { w(a.point, a.units, a.visible); }
inline void fields(Wire& w, GraphicText& t) { w(t.text, t.box, t.anchor, t.layer); }
inline void fields(Wire& w, Presentation::Greys& g) { w(g.of, g.greys); }
inline void fields(Wire& w, Presentation::Area& a) { w(a.of, a.area); }
inline void fields(Wire& w, Presentation::Annotations& a) { w(a.of, a.graphics, a.texts); }
inline void fields(Wire& w, Presentation& p) {
  w(p.label, p.description, p.creator, p.date, p.pictures, p.values, p.greys, p.inverted, p.shutter, p.turn,
    p.areas, p.layers, p.annotations, p.warnings);
}

inline void fields(Wire& w, Code& c) { w(c.value, c.scheme, c.meaning); }
inline void fields(Wire& w, ReportProperty& p) { w(p.name, p.value); }
inline void fields(Wire& w, ReportShape& s) {
  w(s.type, s.inPatient, s.points, s.name, s.frameOfReferenceUid, s.pictures);
}
inline void fields(Wire& w, ReportMeasurement& m) { w(m.name, m.unit, m.value, m.properties, m.shapes); }
inline void fields(Wire& w, MeasurementGroup& g) {
  w(g.trackingId, g.trackingUid, g.category, g.finding, g.site, g.evaluations, g.measurements, g.shapes,
    g.pictures);
}
inline void fields(Wire& w, Report& r) { w(r.title, r.groups, r.warnings); }
inline void fields(Wire& w, KeyObjects& k) { w(k.title, k.text, k.pictures); }

inline void fields(Wire& w, Contour& c) { w(c.type, c.points, c.pictures); }
inline void fields(Wire& w, RegionOfInterest& r) {
  w(r.number, r.name, r.description, r.algorithm, r.type, r.code, r.colour, r.frameOfReferenceUid,
    r.contours);
}
inline void fields(Wire& w, StructureSet& s) { w(s.label, s.name, s.description, s.regions, s.warnings); }

inline void fields(Wire& w, AnatomicStructure& s) { w(s.code, s.modifier); }
inline void fields(Wire& w, AlgorithmIdentity& a) {
  w(a.family, a.nameCode, a.name, a.version, a.parameters, a.source);
}
inline void fields(Wire& w, Segment& s) {
  w(s.number, s.label, s.description, s.category, s.type, s.modifier, s.region, s.regionModifier,
    s.structures, s.algorithmType, s.algorithm, s.algorithms, s.trackingId, s.trackingUid, s.colour);
}
inline void fields(Wire& w, SegmentFrame& f) { w(f.segment, f.origin); }
inline void fields(Wire& w, Segmentation& s) {
  w(s.fractional, s.size, s.right, s.down, s.mm, s.thickness, s.segments, s.frames, s.bits, s.notes);
}

inline void fields(Wire& w, dicom::AttributeLine& l) { w(l.depth, l.tag, l.name, l.vr, l.value); }

}  // namespace volumen::worker
