#include "io/files/image_file.h"

#include <algorithm>
#include <memory>
#include <set>

#include "io/files/formats.h"
#include "io/files/header_text.h"
#include "io/files/nifti.h"
#include "io/regular_file.h"
#include "io/worker/batches.h"
#include "io/worker/file_fields.h"

namespace volumen {

namespace {

// The preamble of a DICOM file may look like another format (TIFF).
bool isDicom(const std::string& head) {
  constexpr std::size_t preamble = 128;
  return head.size() > preamble && head.compare(preamble, 4, "DICM") == 0;
}

// Returns null if no format claims the file.
const FileFormat* formatOf(const std::string& path) {
  constexpr std::size_t enough = 540;
  auto head = readHead(path, enough);
  if (!head || isDicom(*head)) return nullptr;
  const bool isCompressed = head->starts_with("\x1f\x8b");
  if (isCompressed)
    if (auto inside = readDecompressedHead(path, enough)) *head = *inside;
  if (isDicom(*head)) return nullptr;
  const FileClaim claim{*head, lowerCase(path), isCompressed};
  for (const FileFormat& format : fileFormats())
    if (format.claims(claim)) return &format;
  return nullptr;
}

bool holdsGzippedDicom(const std::string& path, const std::string& head) {
  constexpr std::size_t enough = 132;
  if (!head.starts_with("\x1f\x8b")) return false;
  const auto inside = readDecompressedHead(path, enough);
  return inside && isDicom(*inside);
}

// Returns the end of a sentence: the known but unsupported format of a file, and a remedy. Empty for other
// files.
std::string unreadFormatOf(const std::string& path) {
  constexpr std::size_t enough = 132;
  const auto head = readHead(path, enough);
  if (!head || isDicom(*head)) return {};
  if (holdsGzippedDicom(path, *head)) return "gzipped DICOM file, which volumen does not read; unpack it";
  const std::string format = unreadFormat({*head, lowerCase(path)});
  return format.empty() ? format : format + " file, which volumen does not read; convert it to NIfTI or NRRD";
}

Result<ImageHeader> readHeader(const std::string& path) {
  if (const FileFormat* format = formatOf(path)) return format->read(path);
  if (auto file = DataFile::open(path); !file) return file.error();
  if (const std::string format = unreadFormatOf(path); !format.empty())
    return Error{path + " is a " + format + "."};
  return Error{path + " is not a NRRD, NIfTI or MetaImage file."};
}

// True if a header from a worker is consistent and names only files that the worker was given.
bool isConsistent(const ImageHeader& header, const worker::Request& request) {
  constexpr std::uint64_t farthest = std::uint64_t(1) << 48;
  const SampleData& d = header.data;
  SampleData counted = d;
  if (d.files.empty() || d.files.size() > mostDataFiles || d.lineSkip < 0 || d.offset > farthest ||
      d.byteSkip < -1 || d.byteSkip > std::int64_t(farthest) ||
      !setCounts(counted, {d.leading}, {d.voxels}, {d.trailing}, "").ok())
    return false;
  std::set<std::string> given(request.files.begin(), request.files.end());
  given.insert(request.found.begin(), request.found.end());
  return std::ranges::all_of(d.files, [&](const std::string& file) { return given.contains(file); });
}

// Warns of raw data with at least one surplus row: the header's sizes or type may be wrong.
void warnOfSurplus(const ImageHeader& header, std::vector<Warning>& warnings) {
  const SampleData& data = header.data;
  const bool counts =
      data.encoding == Encoding::raw && !data.text && data.lineSkip == 0 && data.byteSkip >= 0;
  if (!counts || header.format == "MGH" || header.format == "VTK") return;  // these formats may hold more
  const std::uint64_t part = data.samples() / data.files.size() * bytesOf(data.type);
  const std::uint64_t needed = data.offset + std::uint64_t(data.byteSkip) + part;
  const std::uint64_t row = std::uint64_t(header.geometry.size.x) * bytesOf(data.type);
  for (const std::string& path : data.files)
    if (const auto file = DataFile::open(path); file && file->size() >= needed + row) {
      warnings.push_back(fileName(path) + " holds " + std::to_string(file->size() - needed) +
                         " bytes more than its header promises; they are not shown.");
      return;
    }
}

// Returns the index of a series' volume in its file, from 0: the number after "NAME#" in its id. A suffix may
// follow that distinguishes files of equal name.
Result<std::uint64_t> volumeNumber(const Series& series, const ImageHeader& header) {
  const std::uint64_t count = header.data.volumes();
  if (count == 1) return std::uint64_t(0);
  const std::string start = fileName(series.path) + '#';
  std::uint64_t number = 0;
  if (series.id.starts_with(start)) {
    const std::string digits = series.id.substr(start.size());
    number =
        std::uint64_t(std::max<std::int64_t>(0, toInteger(digits.substr(0, digits.find('#'))).value_or(0)));
  }
  if (number < 1 || number > count)
    return Error{series.path + " holds " + std::to_string(count) + " volumes, and '" + fieldText(series.id) +
                 "' is none of them."};
  return number - 1;
}

}  // namespace

bool isGzippedDicom(const std::string& path) {
  const auto head = readHead(path, 2);
  return head && holdsGzippedDicom(path, *head);
}

bool looksLikeImageFile(const std::string& path) { return formatOf(path) || !unreadFormatOf(path).empty(); }

Result<std::vector<Series>> readImageFileHeaders(const std::string& path) {
  auto header = readHeader(path);
  if (!header) return header.error();
  Series series;
  series.id = fileName(path);
  series.path = path;
  series.format = header->format;
  series.modality = header->modality;
  if (series.modality == "CT") series.unit = "HU";
  series.description = header->description;
  series.acquired = header->geometry;
  series.valueType = volumeTypeName(header->data.type);
  series.warnings = header->warnings;
  series.files = {path};
  warnOfSurplus(*header, series.warnings);
  const std::uint64_t count = header->data.volumes();
  if (count == 1) return std::vector<Series>{series};
  std::vector<Series> all;
  for (std::uint64_t n = 1; n <= count; ++n) {
    all.push_back(series);
    all.back().id += '#' + std::to_string(n);
    if (n <= header->names.size()) {
      const VolumeName& name = header->names[n - 1];
      all.back().timePoint = name.timePoint;
      all.back().bValue = name.bValue;
      all.back().label = name.label;
    }
  }
  return all;
}

Result<ImageHeader> readImageHeader(const std::string& path, const CancelToken& cancel) {
  worker::Request request = worker::headersOf({path}, cancel);
  worker::Failure failure{};
  auto header = worker::isolated<readHeader>(request, failure, path);
  if (header && worker::isolating() && !isConsistent(*header, request)) failure = worker::Failure::wrong;
  if (failure != worker::Failure::none) return Error{path + ": " + reasonOf(failure, request) + "."};
  return header;
}

Result<Loaded> loadImageFile(const Series& series, const Progress& progress, const CancelToken& cancel) {
  auto header = readImageHeader(series.path, cancel);
  if (!header) return header.error();
  auto number = volumeNumber(series, *header);
  if (!number) return number.error();
  Loaded loaded{{}, {}, series.warnings};
  std::vector<std::string> changed;
  auto samples =
      readSamples(header->data, *number, header->slope, header->intercept, progress, cancel, changed);
  if (!samples) return samples.error();
  VolumeParts parts;
  parts.geometry = header->geometry;
  parts.values = std::move(samples->values);
  parts.slope = samples->slope;
  parts.intercept = samples->intercept;
  parts.attributes.name = series.description.empty() ? series.id : series.description;
  parts.attributes.modality = series.modality;
  auto volume = Volume::make(std::move(parts), changed);
  if (!volume) return Error{series.path + ": " + volume.message()};
  addSentences(loaded.warnings, changed);
  loaded.acquired = loaded.drawn = *volume;
  return loaded;
}

}  // namespace volumen
