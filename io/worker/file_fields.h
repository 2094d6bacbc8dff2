#pragma once

#include "io/files/image_header.h"
#include "io/files/text_source.h"
#include "io/worker/study_fields.h"

// How the structs of io/files are sent to and from workers.
namespace volumen::worker {

template <>
inline constexpr SampleType lastOf<SampleType> = SampleType::float64;
template <>
inline constexpr Encoding lastOf<Encoding> = Encoding::hex;

inline void fields(Wire& w, TextSamples& s) { w(s.type, s.count); }
inline void fields(Wire& w, VolumeName& n) { w(n.timePoint, n.bValue, n.label); }

inline void fields(Wire& w, SampleData& d) {
  w(d.type, d.bigEndian, d.text, d.encoding, d.files, d.offset, d.lineSkip, d.byteSkip, d.leading, d.voxels,
    d.trailing);
}

inline void fields(Wire& w, ImageHeader& h) {
  w(h.format, h.description, h.modality, h.data, h.geometry, h.slope, h.intercept, h.names, h.keyValues,
    h.warnings);
}

}  // namespace volumen::worker
