#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include "io/dicom/attributes.h"
#include "io/dicom/cielab.h"
#include "io/dicom/derived_object.h"
#include "io/dicom/frame_scopes.h"
#include "io/dicom/isolated_file.h"
#include "io/dicom/label_frames.h"
#include "io/dicom/pixel_size.h"
#include "io/dicom/segmentation_pixels.h"
#include "io/segmentation.h"
#include "io/worker/object_fields.h"
#include "viewer/segment/packed_bits.h"
#include "viewer/volume/listed_first.h"

namespace volumen {
namespace dicom {
namespace {

using Scope = DataSet::Scope;

constexpr std::uint32_t segmentOfFrame = 0x0062000a, typeOfSegment = 0x0062000f, regionOfSegment = 0x00082218,
                        numberOfFrames = 0x00280008;
constexpr std::size_t noSegment = SIZE_MAX;

SegmentAlgorithm algorithmNamed(std::string_view term) {
  const auto found = std::ranges::find(segmentAlgorithmTerms, term);
  return found == segmentAlgorithmTerms.end() ? SegmentAlgorithm::unsaid
                                              : SegmentAlgorithm(found - segmentAlgorithmTerms.begin());
}

std::string numbersText(const std::set<int>& numbers) {
  std::vector<std::string> texts;
  for (const int number : numbers) texts.push_back(std::to_string(number));
  return listedFirst(texts);
}

/// Reads a segmentation object.
class SegmentationReader {
 public:
  SegmentationReader(const InspectedFile& file, const DataSet& data, const std::string& path,
                     glm::ivec2 pictures)
      : file_(file), data_(data), path_(path), pictures_(pictures) {}

  Result<Segmentation> run() {
    if (Status s = readSize(); !s) return s.error();
    if (Status s = readSegments(); !s) return s.error();
    if (Status s = readFrames(); !s) return s.error();
    const Status pixels = isLabelMap_ ? readLabels() : out_.fractional ? readFractions() : readBits();
    if (!pixels) return pixels.error();
    if (Status s = leaveOutUndescribed(); !s) return s.error();
    uniteRepeated();
    return std::move(out_);
  }

 private:
  /// Returns why the value of a text attribute is refused.
  Error wrong(const std::string& name, std::uint32_t tag, Scope scope, const char* wanted) const {
    constexpr std::size_t mostShown = 64;
    if (!data_.has(tag, scope)) return Error{"its " + name + " is missing"};
    return Error{"its " + name + " is \"" + toUtf8(data_.text(tag, scope).substr(0, mostShown), {}) +
                 "\", not " + wanted};
  }

  Result<int> readLength(const char* name, std::uint32_t tag) const {
    const auto length = data_.word(tag, data_.root());
    if (!length) return Error{std::string("its ") + name + " is missing"};
    if (*length == 0) return Error{std::string("its ") + name + " is 0"};
    return int(*length);
  }

  Status readSize() {
    const Scope root = data_.root();
    const std::string type = data_.text(0x00620001, root);
    isLabelMap_ = type == "LABELMAP";
    out_.fractional = type == "FRACTIONAL";
    if (type != "BINARY" && !out_.fractional && !isLabelMap_)
      return Error{"its SegmentationType is \"" + toUtf8(type, {}) +
                   "\"; BINARY, FRACTIONAL and LABELMAP are read"};
    const Result<int> rows = readLength("Rows", 0x00280010), columns = readLength("Columns", 0x00280011);
    if (!rows) return rows.error();
    if (!columns) return columns.error();
    out_.size = {*columns, *rows};
    frames_ = data_.has(numberOfFrames, root) ? data_.number(numberOfFrames, root).value_or(0) : 1;
    if (!(frames_ >= 1 && frames_ <= frameLimit && frames_ == std::floor(frames_)))
      return wrong("NumberOfFrames", numberOfFrames, root, "a number of frames");
    const int samples = data_.word(0x00280002, root).value_or(1);
    if (samples != 1) return Error{"its SamplesPerPixel is " + std::to_string(samples) + ", not 1"};
    const auto said = data_.word(0x00280100, root);
    if (!said && isLabelMap_) return Error{"its BitsAllocated is missing"};
    if (!said)
      out_.notes.push_back("The BitsAllocated of " + path_ + " is missing: that of " + type + " is taken.");
    const int allocated = said.value_or(std::uint16_t(out_.fractional ? 8 : 1));
    if (!(isLabelMap_ ? allocated == 8 || allocated == 16 : allocated == (out_.fractional ? 8 : 1)))
      return Error{"its SegmentationType is \"" + type + "\", and its BitsAllocated " +
                   std::to_string(allocated) + ", which does not go with it"};
    if (isLabelMap_) background_ = data_.word(0x00280120, root).value_or(0);
    if (!file_.scanned.dataSet.pixels) return Error{"it has no pixel data"};
    return {};
  }

  Status readSegments() {
    for (const Scope item : data_.items(0x00620002, data_.root())) {
      Segment segment;
      segment.number = data_.word(0x00620004, item).value_or(0);
      if (isLabelMap_ && segment.number == background_) continue;
      segment.label = data_.utf8(0x00620005, item);
      segment.description = data_.utf8(0x00620006, item);
      segment.category = codeAt(data_, 0x00620003, item);
      segment.type = codeAt(data_, typeOfSegment, item);
      if (const auto types = data_.items(typeOfSegment, item); !types.empty())
        segment.modifier = codeAt(data_, 0x00620011, types[0]);
      readProvenance(item, segment);
      segment.colour = readCieLab(data_, 0x0062000d, item);
      if (!byNumber_.emplace(segment.number, out_.segments.size()).second)
        return Error{"two of its segments have the number " + std::to_string(segment.number)};
      out_.segments.push_back(std::move(segment));
    }
    return {};
  }

  void readProvenance(Scope item, Segment& segment) const {
    segment.algorithmType = algorithmNamed(data_.text(0x00620008, item));
    segment.algorithm = data_.utf8(0x00620009, item);
    segment.trackingId = data_.utf8(0x00620020, item);
    segment.trackingUid = data_.text(0x00620021, item);
    segment.region = codeAt(data_, regionOfSegment, item);
    if (const auto regions = data_.items(regionOfSegment, item); !regions.empty())
      segment.regionModifier = codeAt(data_, 0x00082220, regions[0]);
    for (const Scope structure : data_.items(0x00082228, item))
      segment.structures.push_back({codeIn(data_, structure), codeAt(data_, 0x00082230, structure)});
    for (const Scope algorithm : data_.items(0x00620007, item))
      segment.algorithms.push_back({codeAt(data_, 0x0066002f, algorithm),
                                    codeAt(data_, 0x00660030, algorithm), data_.utf8(0x00660036, algorithm),
                                    data_.utf8(0x00660031, algorithm), data_.utf8(0x00660032, algorithm),
                                    data_.utf8(0x00240202, algorithm)});
  }

  Status readFrames() {
    const auto ofAll = data_.items(FrameScopes::sharedGroups, data_.root());
    const auto ofFrames = data_.items(FrameScopes::perFrameGroups, data_.root());
    const bool isCounted = data_.has(numberOfFrames, data_.root());
    if (double(ofFrames.size()) != frames_)
      return Error{"its NumberOfFrames is " +
                   (isCounted ? std::to_string(std::int64_t(frames_)) : std::string("missing")) +
                   ", but it has functional groups for " + std::to_string(ofFrames.size()) + " frames"};
    for (std::size_t n = 0; n < ofFrames.size(); ++n) {
      const FrameScopes at(data_, ofFrames[n], ofAll.empty() ? Scope{} : ofAll[0]);
      if (Status s = readFrame(at); !s) return Error{"frame " + std::to_string(n + 1) + ": " + s.message()};
    }
    return {};
  }

  /// Returns the index of the frame's segment. Label maps get 0, as their pixels name the segments.
  std::size_t segmentOf(const FrameScopes& at) {
    if (isLabelMap_) return 0;
    const int number = data_.word(0x0062000b, at.of(segmentOfFrame)).value_or(0);
    const auto found = byNumber_.find(number);
    if (found != byNumber_.end()) return found->second;
    undescribed_.insert(number);
    return noSegment;
  }

  Status readFrame(const FrameScopes& at) {
    const auto segment = segmentOf(at);
    if (segment == noSegment) {
      out_.frames.push_back({noSegment});
      return {};
    }
    const Scope place = at.ofGroupAlone(0x00209113), plane = at.of(0x00209116),
                measures = at.of(pixelMeasures);
    const auto position = data_.numbers(0x00200032, place);
    if (!position || position->size() < 3)
      return wrong("ImagePositionPatient", 0x00200032, place, "three numbers");
    const auto directions = data_.numbers(0x00200037, plane);
    if (!directions || directions->size() < 6)
      return wrong("ImageOrientationPatient", 0x00200037, plane, "six numbers");
    const auto mm = readSpacing(data_, 0x00280030, measures);
    if (!mm) return wrong("PixelSpacing", 0x00280030, measures, "two lengths above 0");
    constexpr double farthest = 1e7;
    if (std::ranges::any_of(*position, [](double x) { return std::abs(x) > farthest; }))
      return Error{"its place is more than 10 km away"};
    const std::vector<double>&p = *position, &d = *directions;
    if (!std::exchange(hasPlane_, true))
      if (Status s = takePlane({d[0], d[1], d[2]}, {d[3], d[4], d[5]}, *mm, at); !s) return s;
    constexpr double off = 1e-4;
    if (glm::distance(out_.right, {d[0], d[1], d[2]}) > off ||
        glm::distance(out_.down, {d[3], d[4], d[5]}) > off || glm::distance(out_.mm, *mm) > off)
      return Error{"its directions or pixel spacing are not those of the first frame"};
    out_.frames.push_back({segment, {p[0], p[1], p[2]}});
    return {};
  }

  /// Stores directions, pixel size and thickness of the first frame.
  Status takePlane(glm::dvec3 right, glm::dvec3 down, glm::dvec2 mm, const FrameScopes& at) {
    constexpr double off = 0.01;
    const bool square = std::abs(glm::length(right) - 1) < off && std::abs(glm::length(down) - 1) < off &&
                        std::abs(glm::dot(right, down)) < off;
    if (!square) return Error{"its directions are no unit vectors at right angles"};
    out_.right = right;
    out_.down = down;
    out_.mm = mm;
    for (const std::uint32_t tag : {0x00180088u, 0x00180050u}) {
      const double thickness = data_.number(tag, at.of(pixelMeasures)).value_or(0);
      if (!(thickness > 0)) continue;
      out_.thickness = thickness;
      break;
    }
    return {};
  }

  SegmentationPixels pixels() const { return {file_, data_, path_, out_.size, int(frames_), pictures_}; }

  /// Reads bits, which run on from frame to frame (PS3.5 8.1.1).
  Status readBits() {
    auto bits = pixels().bits(out_.notes);
    if (!bits) return bits.error();
    out_.bits = std::move(*bits);
    return {};
  }

  /// Reads fractions of MaximumFractionalValue, one byte a pixel.
  Status readFractions() {
    const int most = data_.word(0x0062000e, data_.root()).value_or(255);
    if (most < 1 || most > 255)
      return Error{"its MaximumFractionalValue is " + std::to_string(most) +
                   ", not 1 to 255 as its 8 bits can hold"};
    BitPacker bits;
    const Status read = pixels().forEachFrame([&](std::size_t, std::span<const int> fractions) -> Status {
      for (const int fraction : fractions) bits.add(fraction > 0 && 2 * fraction >= most, 1);
      return {};
    });
    if (!read) return read;
    out_.bits = bits.bytes();
    return {};
  }

  /// Reads a label map. Each frame becomes one frame for every segment that has pixels in it.
  Status readLabels() {
    const std::vector<SegmentFrame> planes = std::exchange(out_.frames, {});
    LabelFrames frames(byNumber_, background_, out_.rowAt(1, 0));
    const Status read = pixels().forEachFrame([&](std::size_t n, std::span<const int> numbers) -> Status {
      for (const std::size_t segment : frames.add(numbers))
        out_.frames.push_back({segment, planes[n].origin});
      return {};
    });
    if (!read) return read;
    out_.bits = frames.bits();
    addPaletteColours(out_.segments, data_);
    if (!frames.undescribed().empty())
      out_.notes.push_back("Pixels of " + path_ + " are of segments that it does not describe (" +
                           numbersText(frames.undescribed()) + "): they were left out.");
    return {};
  }

  /// Leaves out frames of segments missing from SegmentSequence, as long as others remain.
  Status leaveOutUndescribed() {
    std::vector<std::size_t> kept;
    for (std::size_t n = 0; n < out_.frames.size(); ++n)
      if (out_.frames[n].segment != noSegment) kept.push_back(n);
    const std::size_t count = out_.frames.size() - kept.size();
    if (count == 0) return {};
    if (kept.empty()) return Error{"frame 1: its segment is not one of those of the file"};
    keepFrames(kept);
    out_.notes.push_back((count == 1 ? "A frame of " + path_ + " is"
                                     : std::to_string(count) + " frames of " + path_ + " are") +
                         " of a segment that it does not describe (" + numbersText(undescribed_) +
                         "): left out.");
    return {};
  }

  /// Merges frames that repeat a position of their segment into the first, as a position has one frame.
  void uniteRepeated() {
    std::map<std::array<std::int64_t, 4>, std::size_t> firstAt;
    std::vector<std::size_t> kept;
    for (std::size_t n = 0; n < out_.frames.size(); ++n) {
      const glm::dvec3 um = 1000.0 * out_.frames[n].origin;
      const auto [first, isNew] =
          firstAt.emplace(std::array{std::int64_t(out_.frames[n].segment), std::int64_t(std::llround(um.x)),
                                     std::int64_t(std::llround(um.y)), std::int64_t(std::llround(um.z))},
                          n);
      isNew ? kept.push_back(n) : addBits(n, first->second);
    }
    const std::size_t repeated = out_.frames.size() - kept.size();
    if (repeated == 0) return;
    keepFrames(kept);
    out_.notes.push_back("Frames of " + path_ + " repeat a place of their segment (" +
                         std::to_string(repeated) + "): their voxels are united with those of the first.");
  }

  void addBits(std::size_t from, std::size_t to) {
    const std::size_t pixels = out_.rowAt(1, 0);
    for (std::size_t n = 0; n < pixels; ++n)
      if (bitAt(out_.bits, from * pixels + n))
        out_.bits[(to * pixels + n) / 8] |= std::uint8_t(1 << (to * pixels + n) % 8);
  }

  void keepFrames(const std::vector<std::size_t>& kept) {
    const std::size_t pixels = out_.rowAt(1, 0);
    std::vector<SegmentFrame> frames;
    std::vector<std::uint64_t> words((pixels + 63) / 64);
    BitPacker bits;
    for (const std::size_t n : kept) {
      frames.push_back(out_.frames[n]);
      unpackWords(out_.bits, n * pixels, pixels, words);
      bits.add(words, pixels);
    }
    out_.frames = std::move(frames);
    out_.bits = bits.bytes();
  }

  const InspectedFile& file_;
  const DataSet& data_;
  std::string path_;
  glm::ivec2 pictures_;
  double frames_ = 0;
  bool isLabelMap_ = false, hasPlane_ = false;
  int background_ = 0;  // value of unlabelled pixels in a label map
  std::unordered_map<int, std::size_t> byNumber_;
  std::set<int> undescribed_;  // segment numbers
  Segmentation out_;
};

}  // namespace
}  // namespace dicom

namespace {

Result<Segmentation> loadSegmentationHere(const std::string& path, const glm::ivec2& pictures) {
  return dicom::loadObject<Segmentation>(path, DerivedKind::segmentation,
                                         [&](const dicom::InspectedFile& file, const dicom::DataSet& data) {
                                           return dicom::SegmentationReader(file, data, path, pictures).run();
                                         });
}

}  // namespace

// A label map has many segments in few bytes.
Result<Segmentation> loadSegmentation(const std::string& path, glm::ivec2 pictures) {
  constexpr std::uint64_t pixelsAByte = 8, mostPixels = std::uint64_t(1) << 27;
  std::error_code none;
  const std::uint64_t bytes = std::filesystem::file_size(path, none);
  const std::uint64_t pixels = none ? 0 : std::min(bytes, mostPixels / pixelsAByte) * pixelsAByte;
  return dicom::isolatedFile<loadSegmentationHere>(path, pixels, pictures);
}

}  // namespace volumen
