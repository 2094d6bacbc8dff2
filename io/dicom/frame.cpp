#include <algorithm>
#include <cmath>
#include <new>

#include "io/dicom/colour.h"
#include "io/dicom/greys.h"
#include "io/dicom/import.h"
#include "io/dicom/isolated_file.h"
#include "io/dicom/lookup_table.h"
#include "io/dicom/overlays.h"
#include "io/dicom/pixel_size.h"
#include "io/dicom/shutter.h"
#include "io/worker/object_fields.h"
#include "viewer/slice/pyramid.h"

namespace volumen {
namespace worker {

void fields(Wire& w, dicom::Shown& s) { w(s.values, s.inverted, s.shutter, s.greys); }

}  // namespace worker

namespace dicom {
namespace {

/// Returns the file's own mapping: the Modality LUT Sequence if present, else the rescale of the frame (PS3.3
/// C.11.1).
Result<ValueMapping> readValueMapping(const DataSet& data, const FileHeader& header, const Slice& slice) {
  ValueMapping mapping{slice.slope, slice.intercept, 0, {}, slice.unit};
  if (header.format.kind != PixelFormat::Kind::integer) return mapping;
  if (Status s = readModalityLut(data, header.format.isSigned, mapping); !s) return s.error();
  return mapping;
}

/// Returns whether a rescale alone maps stored integers to values.
bool isRescale(const ValueMapping& mapping) {
  return mapping.table.empty() && mapping.slope != 0 && std::isfinite(mapping.slope) &&
         std::isfinite(mapping.intercept);
}

template <class Stored>
inline constexpr bool isKept = std::is_same_v<Stored, std::uint8_t> || std::is_same_v<Stored, std::int16_t> ||
                               std::is_same_v<Stored, std::uint16_t>;

PixelValues valuesOf(Samples samples, const ValueMapping& mapping) {
  return std::visit(
      [&]<class Stored>(std::vector<Stored>& stored) -> PixelValues {
        if constexpr (isKept<Stored>)
          if (isRescale(mapping)) return {std::move(stored), mapping.slope, mapping.intercept};
        std::vector<float> values(stored.size());
        std::ranges::transform(stored, values.begin(), [&](Stored v) { return mapping(double(v)); });
        return values;
      },
      samples);
}

std::optional<ValueRange> paddingValues(const Slice& slice, const ValueMapping& mapping) {
  if (!slice.padding) return {};
  const double a = mapping(slice.padding->low), b = mapping(slice.padding->high);
  return ValueRange{std::min(a, b), std::max(a, b)};
}

const Slice& sliceOf(const FileHeader& header, int n) {
  return header.slices[header.slices.size() == 1 ? 0 : std::size_t(n)];
}

std::optional<FramePlace> placeOf(const Slice& slice, const PixelSize& pixel) {
  if (!isPlaced(slice) || slice.ofTransducer || pixel.kind != PixelSizeKind::patient) return {};
  return FramePlace{*slice.position, slice.orientation->row, slice.orientation->column};
}

/// Returns a value of PatientOrientation with superior and inferior for head and feet; empty for other
/// letters.
std::string sideOf(std::string letters) {
  std::ranges::replace(letters, 'H', 'S');
  std::ranges::replace(letters, 'F', 'I');
  return letters.find_first_not_of("LRAPSI") == std::string::npos ? letters : std::string();
}

void readSides(const DataSet& data, Frame& frame) {
  const std::string text = data.text(0x00200020, data.root());
  const auto end = text.find('\\');
  if (end == std::string::npos) return;
  frame.rowSide = sideOf(text.substr(0, end));
  frame.columnSide = sideOf(text.substr(end + 1));
}

/// Returns a window over all values that stored values can give.
GreyMapping allValues(const PixelFormat& format, const ValueMapping& mapping) {
  const double count = std::exp2(format.bitsStored), lowest = format.isSigned ? -count / 2 : 0;
  double low = mapping(lowest), high = mapping(lowest + count - 1);
  if (!mapping.table.empty()) {
    const auto [least, most] = std::ranges::minmax(mapping.table);
    low = least, high = most;
  }
  const double width = std::abs(high - low);
  return {{(low + high) / 2, width > 0 ? width : 1}, WindowFunction::linearExact, {}, false};
}

/// Returns the greys of a presentation state, which only its shape may invert.
std::vector<NamedGrey> shownGreys(const Shown& shown, const PixelFormat& format) {
  std::vector<NamedGrey> greys = shown.greys;
  if (greys.empty()) greys.push_back({{}, allValues(format, shown.values), true});
  for (NamedGrey& grey : greys) grey.mapping.inverted = shown.inverted;
  return greys;
}

Status addGreys(const DataSet& data, const FileHeader& header, DecodedFrame decoded, int n,
                const std::optional<Shown>& shown, Frame& frame) {
  const Slice& slice = sliceOf(header, n);
  const auto mapping = shown ? Result<ValueMapping>(shown->values) : readValueMapping(data, header, slice);
  if (!mapping) return mapping.error();
  frame.values = valuesOf(std::move(decoded.samples), *mapping);
  frame.mapping = *mapping;
  frame.padding = paddingValues(slice, *mapping);
  frame.unit = mapping->unit;
  frame.greys = shown ? shownGreys(*shown, header.format)
                      : readGreys(data, FrameScopes(data, n), header, slice, frame, frame.warnings);
  if (!shown && slice.isMapped) frame.warnings.push_back("Its " + realWorldSentence + ".");
  return {};
}

/// Returns whether greys cannot be told without values: without a window they are a range of these, and a
/// table's first input may be negative.
bool areGreysOfValues(const DataSet& data, const FrameScopes& at) {
  constexpr std::uint32_t voiLutSequence = 0x00283010;
  const DataSet::Scope scope = at.of(frameVoiLut);
  return readWindows(data, scope).empty() || !data.items(voiLutSequence, scope).empty();
}

void addCovers(const DataSet& data, const FrameScopes& at, const InspectedFile& file,
               const PixelSource& pixels, int n, const std::optional<Shown>& shown, Frame& frame) {
  frame.overlays = readOverlays(data, pixels, file.found.header, n, frame.warnings);
  const Shutter shutter = shown ? shown->shutter : readShutter(data, at, frame.warnings);
  frame.shutter = hiddenBy(shutter, frame.size, frame.pixel.mm);
  frame.shutterGrey = shutter.grey;
}

enum class FrameParts { all, greys };

Result<Frame> readFrame(const InspectedFile& file, int n, const std::optional<Shown>& shown,
                        FrameParts parts = FrameParts::all) {
  const FileHeader& header = file.found.header;
  const PixelFormat& format = header.format;
  if (n < 0 || n >= format.frames)
    return Error{"there is no frame " + std::to_string(n) + ": it holds " + std::to_string(format.frames)};
  const auto pixels = PixelSource::open(header);
  if (!pixels) return pixels.error();
  const DataSet data(file.scanned.head, file.scanned.dataSet.elements);
  const FrameScopes at(data, n);
  const bool isDecoded = parts == FrameParts::all || (format.isGrey() && areGreysOfValues(data, at));
  auto decoded = isDecoded ? pixels->frame(n) : DecodedFrame{};
  if (!decoded) return decoded.error();
  Frame frame;
  frame.size = {format.columns, format.rows};
  if (!decoded->note.empty()) frame.warnings.push_back(decoded->note + ".");
  if (format.isGrey()) {
    if (Status s = addGreys(data, header, *std::move(decoded), n, shown, frame); !s) return s.error();
  } else if (isDecoded) {
    auto rgb = toRgb(*decoded, format, data, frame.warnings);
    if (!rgb) return rgb.error();
    frame.rgb = std::move(*rgb);
  }
  frame.pixel = readPixelSize(data, at, header.modality);
  frame.place = placeOf(sliceOf(header, n), frame.pixel);
  readSides(data, frame);
  // An ultrasound picture has mm only in its regions. Its PixelSpacing is not reliable.
  if (header.modality == "US" && !isPlaced(sliceOf(header, n))) frame.pixel.kind = PixelSizeKind::unknown;
  if (parts == FrameParts::all)
    addCovers(data, at, file, *pixels, n, shown, frame);
  else
    frame.values = {};
  frame.regions = readRegions(data);
  for (const std::string& remark : data.remarks())
    if (std::ranges::find(header.warnings, remark) == header.warnings.end())
      frame.warnings.push_back(sentenceOf(remark));
  return frame;
}

/// Returns read(file). Errors name the path.
template <class Read>
auto readPicture(const std::string& path, const Read& read) -> decltype(read(InspectedFile())) {
  try {
    const InspectedFile file = inspectFile(path);
    if (file.found.kind != Inspection::Kind::picture)
      return Error{path + ": " + (file.found.text.empty() ? "it is no DICOM picture." : file.found.text)};
    auto found = read(file);
    if (!found) return Error{path + ": " + found.message() + "."};
    return found;
  } catch (const std::bad_alloc&) {
    return Error{path + ": there is not enough memory to show it."};
  }
}

Result<Frame> loadFrameHere(const std::string& path, int n, const std::optional<Shown>& shown) {
  return readPicture(path, [&](const InspectedFile& file) { return readFrame(file, n, shown); });
}

Result<std::vector<Frame>> loadFrameGreysHere(const std::string& path, const std::vector<int>& frames) {
  return readPicture(path, [&](const InspectedFile& file) -> Result<std::vector<Frame>> {
    std::vector<Frame> all;
    for (const int n : frames) {
      auto frame = readFrame(file, n, {}, FrameParts::greys);
      if (!frame) return frame.error();
      all.push_back(*std::move(frame));
    }
    return all;
  });
}

/// Runs in the worker, so that only the means are sent.
Result<Frame> loadSmallFrameHere(const std::string& path, int n, int edge) {
  Result<Frame> frame = loadFrameHere(path, n, {});
  if (!frame || frame->colour()) return frame;
  std::optional<SmallPicture> small = smallPicture(frame->values.stored, frame->size, edge);
  if (!small) return frame;
  std::ranges::transform(small->means, small->means.begin(),
                         [&](float v) { return frame->values.of(double(v)); });
  frame->values = std::move(small->means);
  frame->size = small->size;
  frame->pixel.mm *= small->block;
  frame->overlays.clear();
  frame->shutter.clear();
  return frame;
}

}  // namespace

Result<Frame> loadSmallFrame(const std::string& path, int n, std::uint64_t pixels, int edge) {
  return isolatedFile<loadSmallFrameHere>(path, pixels, n, edge);
}

Result<Frame> loadFrame(const std::string& path, int n, std::uint64_t pixels,
                        const std::optional<Shown>& shown, const Progress& progress) {
  return isolatedPicture<loadFrameHere>(path, pixels, progress, n, shown);
}

Result<std::vector<Frame>> loadFrameGreys(const std::string& path, const std::vector<int>& frames,
                                          std::uint64_t pixels) {
  auto all = isolatedFile<loadFrameGreysHere>(path, pixels, frames);
  if (all && all->size() != frames.size())
    return Error{path + ": " + worker::reasonOf(worker::Failure::wrong) + "."};
  return all;
}

}  // namespace dicom
}  // namespace volumen
