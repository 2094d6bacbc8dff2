#pragma once

#include "io/dicom/decode.h"
#include "io/worker/study_fields.h"

// How the structs of io/dicom are sent to and from workers.
namespace volumen::worker {

template <>
inline constexpr dicom::PixelFormat::Kind lastOf<dicom::PixelFormat::Kind> =
    dicom::PixelFormat::Kind::float64;
template <>
inline constexpr dicom::Inspection::Kind lastOf<dicom::Inspection::Kind> = dicom::Inspection::Kind::picture;

inline void fields(Wire& w, dicom::PixelFormat& f) {
  w(f.kind, f.columns, f.rows, f.frames, f.bitsAllocated, f.bitsStored, f.highBit, f.isSigned, f.bigEndian,
    f.bytesInWords, f.photometric, f.samples, f.planar, f.subsampled);
}

/// Sends the UID, as the other side finds the texts in its own table.
inline void fields(Wire& w, dicom::TransferSyntax& syntax) {
  std::string uid = w.reading() ? "" : syntax.uid;
  dicom::Encoding encoding = syntax.encoding;
  w(uid, encoding.explicitVr, encoding.bigEndian);
  if (!w.reading()) return;
  syntax = dicom::transferSyntax(uid);
  syntax.encoding = encoding;
}

inline void fields(Wire& w, dicom::Range& r) { w(r.offset, r.length); }
inline void fields(Wire& w, dicom::Orientation& o) { w(o.row, o.column); }
inline void fields(Wire& w, dicom::Mosaic& m) { w(m.columns, m.rows, m.tilesAcross); }
inline void fields(Wire& w, dicom::Concatenation& c) { w(c.uid, c.part, c.parts, c.firstFrame); }

inline void fields(Wire& w, dicom::Slice& s) {
  w(s.frame, s.position, s.orientation, s.ofTransducer, s.spacing, s.thickness, s.slope, s.intercept,
    s.isRescaled, s.unit, s.isMapped, s.padding, s.windows, s.instance, s.echoTime, s.bValue, s.timePoint,
    s.inStack, s.separators);
}

inline void fields(Wire& w, dicom::PetFacts& p) {
  w(p.units, p.suvType, p.decayCorrection, p.weight, p.size, p.dose, p.halfLife, p.injectionDateTime,
    p.injectionTime, p.zone, p.decayedTo, p.seriesDate, p.seriesTime, p.acquisitionDate, p.acquisitionTime,
    p.geScanStart, p.philipsSuvFactor, p.philipsBqFactor, p.injections, p.isEnhanced, p.attenuationCorrected,
    p.decayCorrected, p.mappedType, p.mappedFactor);
}

inline void fields(Wire& w, dicom::FileHeader& h) {
  fields(w, static_cast<SeriesIdentity&>(h));
  w(h.path, h.sopInstanceUid, h.unit, h.time, h.contrastAgent, h.syntax, h.format, h.mosaic, h.concatenation,
    h.frames, h.inflatedFrom, h.slices, h.notVolume, h.cine, h.warnings);
  w(h.pet);
}

inline void fields(Wire& w, dicom::ListedFile& f) { w(f.id, f.studyUid, f.seriesUid, f.isPicture); }

inline void fields(Wire& w, dicom::Inspection& i) {
  w(i.kind, i.text, i.derivedObject, i.listed);
  if (i.kind == dicom::Inspection::Kind::picture) return w(i.header);
  fields(w, static_cast<SeriesIdentity&>(i.header));
  w(i.position);
}

inline void fields(Wire& w, dicom::DecodedFrame& f) { w(f.samples, f.note, f.ybr); }

}  // namespace volumen::worker
