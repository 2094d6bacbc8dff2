#include "io/export/rtstruct.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <new>

#include "io/export/dicom_file.h"
#include "io/export/dicom_uid.h"
#include "io/export/segmentation_frames.h"
#include "io/segmentation.h"
#include "io/study/series.h"
#include "viewer/segment/acquired_slices.h"
#include "viewer/segment/pixel_outlines.h"
#include "viewer/segment/tissue_codes.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/listed_first.h"

namespace volumen {

namespace {

constexpr std::uint32_t contourImages = 0x30060016;

// A segment that has contours.
struct WrittenRegion {
  const Segment* segment = nullptr;
  std::string name;
  DicomElements contours;
  double mm3 = 0;  // volume inside the contours
};

// Rounds mm so that a point moves by at most 1/1000 pixel, and by far less than 0.01 mm.
double roundedTo(double mm, double pixel) {
  const double places = std::pow(10, std::ceil(-std::log10(std::min(pixel, 1.0) / 1000)));
  return std::round(mm * places) / places;
}

std::string contourData(const std::vector<glm::ivec2>& outline, const DicomSourceFrame::Place& at) {
  const double pixel = std::min(at.mm.x, at.mm.y);
  std::string data;
  for (const glm::ivec2 corner : outline) {
    const glm::dvec2 mm = (glm::dvec2(corner) - 0.5) * at.mm;  // corner 0, 0 is half a pixel before a centre
    const glm::dvec3 p = at.position + mm.x * at.right + mm.y * at.down;
    for (int axis = 0; axis < 3; ++axis) {
      if (!data.empty()) data += '\\';
      data += decimal(roundedTo(p[axis], pixel));
    }
  }
  return data;
}

// Makes the contours of the segments on the slices of a series.
class RegionMaker {
 public:
  // `distance` is the spacing of the grid's slices in mm.
  RegionMaker(const DicomSource& source, glm::ivec2 size, double distance)
      : source_(source), size_(size), distance_(distance) {
    const glm::dvec3 normal = glm::cross(place(0).right, place(0).down);
    std::vector<double> places;
    for (int slice = 0; slice < int(source.slices.size()); ++slice)
      places.push_back(glm::dot(place(slice).position, normal) / distance);
    for (const double share : sharesOf(places)) sharesMm_.push_back(share * distance);
  }

  // Adds the contours of `frames`, which hold one segment.
  void add(const SegmentationFrames& frames, WrittenRegion& region) const {
    const std::vector<std::uint8_t> bits = frames.bits().bytes();
    std::vector<std::uint8_t> pixels(std::size_t(size_.x) * std::size_t(size_.y));
    // A grid slice without an acquired slice stays empty when the contours are read.
    const bool isUneven = !frames.slicesBetween().empty();
    int number = 0;
    for (std::size_t n = 0; n < frames.frames().size(); ++n) {
      const int slice = frames.frames()[n].slice;
      unpackBits(bits, n * pixels.size(), pixels);
      for (const auto& outline : pixelOutlines(pixels, size_))
        append(region.contours, contour(outline, slice, ++number));
      region.mm3 += double(std::ranges::count(pixels, std::uint8_t(1))) * place(slice).mm.x *
                    place(slice).mm.y * (isUneven ? sharesMm_[std::size_t(slice)] : distance_);
    }
  }

  // Returns true if a slice is not perpendicular to the z axis.
  bool isOblique() const {
    constexpr double off = 1e-4;
    const glm::dvec3 normal = glm::cross(place(0).right, place(0).down);
    return std::abs(normal.z) < 1 - off * off / 2;
  }

 private:
  const DicomSourceFrame::Place& place(int slice) const { return *source_.frame(slice).place; }

  DicomElements contour(const std::vector<glm::ivec2>& outline, int slice, int number) const {
    const DicomSourceFile& file = source_.file(slice);
    const int frame = file.isMultiFrame() ? int(source_.slices[std::size_t(slice)].frame) + 1 : 0;
    const SourcePicture picture{file.sopClassUid, file.sopInstanceUid, frame};
    DicomElements all = {{dicomItem, {}, 0, 2}};
    append(all, references(contourImages, {&picture, 1}, 2));
    append(all, {{0x30060042, "CLOSED_PLANAR", 0, 2},
                 {0x30060046, std::to_string(outline.size()), 0, 2},
                 {0x30060048, std::to_string(number), 0, 2},
                 {0x30060050, contourData(outline, place(slice)), 0, 2}});
    return all;
  }

  const DicomSource& source_;
  glm::ivec2 size_;
  double distance_;
  std::vector<double> sharesMm_;  // length along the normal that belongs to each slice
};

std::string regionName(const Segment& segment, std::size_t n) {
  const std::string line = inOneLine(segment.label);
  return line.find_first_not_of(' ') == std::string::npos ? "Segment " + std::to_string(n) : line;
}

std::string volumeNote(const WrittenRegion& region, double mm3) {
  constexpr double off = 0.005;
  if (std::abs(region.mm3 - mm3) <= off * mm3) return {};
  char text[160];
  std::snprintf(text, sizeof text, " has %.3g ml; its contours on the acquired slices enclose %.3g ml.",
                mm3 / 1000, region.mm3 / 1000);
  return region.name + text;
}

DicomElements structureSetModule(const StudyObject& object, const Series& series,
                                 const StructureSetTags& tags, const std::string& space) {
  const ObjectTags& dated = object.tags();
  DicomElements all = frameOfReferenceModule(space);
  append(all, {{0x00081070, ""},
               {0x00200013, "1"},
               {0x30060002, firstCharacters(inOneLine(tags.label), 16)},
               {0x30060004, inOneLine(tags.description)},
               {0x30060008, dated.date},
               {0x30060009, dated.time},
               {0x300e0002, "UNAPPROVED"},
               {0x30060010, {}},
               {dicomItem, {}, 0, 1},
               {0x00200052, space, 0, 1},
               {0x30060012, {}, 0, 1},
               {dicomItem, {}, 0, 2},
               {0x00081150, "1.2.840.10008.3.1.2.3.1", 0, 2},  // Detached Study Management, as C.8.8.5 has it
               {0x00081155, series.studyUid, 0, 2},
               {0x30060014, {}, 0, 2},
               {dicomItem, {}, 0, 3},
               {0x0020000e, series.seriesUid, 0, 3}});
  append(all, references(contourImages, object.pictures(), 3));
  return all;
}

std::string regionColour(const Segment& segment) {
  const TissueCode* tissue = tissueOf(segment.type);
  const glm::u8vec3 c = segment.colour.value_or(tissue ? tissue->colour : glm::u8vec3(255));
  return std::to_string(c.r) + '\\' + std::to_string(c.g) + '\\' + std::to_string(c.b);
}

// The three lists of regions name them by the same numbers (C.8.8.5, C.8.8.6, C.8.8.8).
DicomElements regionLists(const std::vector<WrittenRegion>& regions, const std::string& space) {
  DicomElements named = {{0x30060020, {}}}, drawn = {{0x30060039, {}}}, observed = {{0x30060080, {}}};
  for (std::size_t n = 0; n < regions.size(); ++n) {
    const Segment& segment = *regions[n].segment;
    const std::string number = std::to_string(n + 1);
    append(named,
           {{dicomItem, {}, 0, 1},
            {0x30060022, number, 0, 1},
            {0x30060024, space, 0, 1},
            {0x30060026, regions[n].name, 0, 1},
            {0x30060036, std::string(segmentAlgorithmTerms[std::size_t(segment.algorithmType)]), 0, 1}});
    if (!segment.description.empty())
      named.push_back({0x30060028, firstCharacters(segment.description, 1024), 0, 1});
    if (!segment.algorithm.empty()) named.push_back({0x30060038, inOneLine(segment.algorithm), 0, 1});
    append(drawn, {{dicomItem, {}, 0, 1},
                   {0x3006002a, regionColour(segment), 0, 1},
                   {0x30060084, number, 0, 1},
                   {0x30060040, {}, 0, 1}});
    append(drawn, regions[n].contours);
    const bool isOrgan = segment.category.value == "123037004" && segment.category.scheme == "SCT";
    append(observed, {{dicomItem, {}, 0, 1},
                      {0x30060082, number, 0, 1},
                      {0x30060084, number, 0, 1},
                      {0x300600a4, isOrgan ? "ORGAN" : "", 0, 1},
                      {0x300600a6, "", 0, 1}});
    if (isWhole(segment.type)) append(observed, codeSequence(0x30060086, segment.type, 1));
  }
  append(named, drawn);
  append(named, observed);
  return named;
}

struct MadeRegions {
  std::vector<WrittenRegion> regions;
  std::vector<std::string> notes;
};

Result<MadeRegions> makeRegions(std::span<const Segmented> maps, const RegionMaker& maker,
                                const DicomSource& source, glm::ivec2 size, const Progress& progress,
                                const CancelToken& cancel) {
  MadeRegions made;
  std::vector<std::string> empty, renamed;
  std::size_t count = 0, done = 0;
  for (const Segmented& map : maps) count += map.segments.size();
  for (const Segmented& map : maps)
    for (const Segment& segment : map.segments) {
      if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
      if (progress) progress("drawing contours", done, count);
      const WrittenMask mask = writtenMask(map, segment.number);
      SegmentationFrames frames(map.labels.geometry(), source, size);
      frames.add(mask.drawn, mask.onSlices ? &*mask.onSlices : nullptr);
      WrittenRegion region{&segment, regionName(segment, ++done), {}, 0};
      maker.add(frames, region);
      if (!segment.label.empty() && region.name != segment.label) renamed.push_back(region.name);
      if (region.contours.empty()) {
        empty.push_back(region.name);
        continue;
      }
      const double mm3 = double(mask.drawn.count()) * map.labels.geometry().voxelVolume();
      if (std::string note = volumeNote(region, mm3); !note.empty()) made.notes.push_back(std::move(note));
      made.regions.push_back(std::move(region));
    }
  if (!empty.empty())
    made.notes.push_back("Left out, for they have no pixel on the acquired slices: " + listedFirst(empty) +
                         ".");
  if (!renamed.empty())
    made.notes.push_back("Names in DICOM have one line of at most 64 characters: " + listedFirst(renamed) +
                         ".");
  return made;
}

}  // namespace

Result<std::vector<std::string>> writeStructureSet(std::span<const Segmented> maps, const Series& series,
                                                   const StructureSetTags& tags, const std::string& path,
                                                   const Progress& progress, const CancelToken& cancel) try {
  if (maps.empty() || !maps.front().labels.geometry().calibrated)
    return Error{"No segment lies in " + series.id + "; no structure set was written."};
  const auto object = StudyObject::of(series, tags, progress, cancel);
  if (!object) return object.error();
  if (Status s = checkNames(series); !s) return s.error();
  if (Status s = checkPlaces(series, object->source()); !s) return s.error();
  const glm::ivec2 size(series.acquired.size);
  const RegionMaker maker(object->source(), size, sliceDistance(maps.front().labels.geometry()));
  auto made = makeRegions(maps, maker, object->source(), size, progress, cancel);
  if (!made) return made.error();
  if (made->regions.empty())
    return Error{"Nothing is marked on the slices of " + series.id +
                 ": a structure set without a contour was not written."};
  std::string space = object->valueOfSource(0x00200052);
  if (space.empty()) space = randomUid();
  DicomElements elements = structureSetModule(*object, series, tags, space);
  append(elements, regionLists(made->regions, space));
  DcmFileFormat file;
  object->put(UID_RTStructureSetStorage, "RTSTRUCT", elements, *file.getDataset());
  if (Status s = writeNewDicom(file, path, cancel); !s) return s.error();
  if (maker.isOblique())
    made->notes.emplace_back(
        "The slices do not lie across the body's axis: programs that take one z for each contour (many for "
        "radiotherapy do) place these contours wrongly.");
  return made->notes;
} catch (const std::bad_alloc&) {
  return Error{"Cannot write " + path + ": there is not enough memory."};
}

}  // namespace volumen
