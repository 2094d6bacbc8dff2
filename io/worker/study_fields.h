#pragma once

#include "io/study/derived_object.h"
#include "io/study/series.h"
#include "io/worker/wire.h"

// How the structs of io/study are sent to and from workers.
namespace volumen::worker {

template <>
inline constexpr WarningKind lastOf<WarningKind> = WarningKind::reduced;
template <>
inline constexpr DerivedKind lastOf<DerivedKind> = DerivedKind::segmentation;

inline void fields(Wire& w, SeriesIdentity& s) {
  w(s.patientName, s.patientId, s.patientIdIssuer, s.patientBirthDate, s.patientSex, s.patientAge, s.studyUid,
    s.studyDate, s.studyTime, s.studyId, s.accessionNumber, s.studyDescription, s.seriesUid, s.seriesNumber,
    s.modality, s.description, s.sopClassUid, s.bodyPart, s.laterality, s.viewPosition, s.frameOfReferenceUid,
    s.lossyRatio);
}
inline void fields(Wire& w, Cine& c) { w(c.framesPerSecond, c.frameTimesMs, c.backAndForth); }
inline void fields(Wire& w, ReferencedPicture& p) { w(p.sopInstanceUid, p.seriesUid, p.frames, p.segments); }
inline void fields(Wire& w, DerivedObject& r) {
  fields(w, static_cast<SeriesIdentity&>(r));
  w(r.kind, r.id, r.path, r.sopInstanceUid, r.label, r.text, r.date, r.pictures, r.warnings);
}
inline void fields(Wire& w, VoxelGeometry& g) { w(g.size, g.patientFromVoxelStep, g.origin, g.calibrated); }
inline void fields(Wire& w, ValueRange& r) { w(r.low, r.high); }
inline void fields(Wire& w, Window& window) { w(window.centre, window.width); }

/// Sends sentences and kinds apart, as a Warning has no default constructor.
inline void fields(Wire& w, std::vector<Warning>& warnings) {
  std::vector<std::string> sentences;
  std::vector<std::int32_t> kinds;
  for (const Warning& warning : warnings) {
    sentences.push_back(warning.sentence);
    kinds.push_back(std::int32_t(warning.kind));
  }
  w(sentences, kinds);
  if (!w.reading()) return;
  warnings.clear();
  if (kinds.size() != sentences.size()) return w.fail();
  for (std::size_t n = 0; n < kinds.size(); ++n) {
    if (kinds[n] < 0 || kinds[n] > std::int32_t(lastOf<WarningKind>)) return w.fail();
    warnings.emplace_back(std::move(sentences[n]), WarningKind(kinds[n]));
  }
}

inline void fields(Wire& w, Series::Regular& r) { w(r.geometry, r.interpolatedSlices); }
inline void fields(Wire& w, SplitBy& s) { w(s.attribute, s.value, s.words); }
inline void fields(Wire& w, ProjectionView& p) { w(p.laterality, p.viewPosition); }
inline void fields(Wire& w, Series& s) {
  fields(w, static_cast<SeriesIdentity&>(s));
  w(s.id, s.path, s.format, s.unit, s.contrastAgent, s.time, s.echoTime, s.bValue, s.timePoint, s.label,
    s.splitBy, s.sliceThickness, s.acquired, s.valueType, s.warnings, s.regular, s.files, s.frames,
    s.sopInstanceUids, s.projections, s.notVolume, s.cine);
  w(s.suv.bodyWeight, s.suv.leanBodyMass, s.suv.bodySurface, s.suv.why);
}

}  // namespace volumen::worker
