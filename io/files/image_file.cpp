#include "io/files/image_file.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "io/files/header_text.h"
#include "io/files/meta_image.h"
#include "io/files/nifti.h"
#include "io/files/nrrd.h"

namespace volumen {

namespace {

enum class Format { none, nrrd, nifti, metaImage };

// By content first, so that a wrong name does no harm.
Format formatOf(const std::string& path) {
  constexpr std::size_t enough = 540;
  auto head = readHead(path, enough);
  if (!head) return Format::none;
  if (head->starts_with("NRRD000")) return Format::nrrd;
  if (head->starts_with("ObjectType = Image") || head->starts_with("NDims = ")) return Format::metaImage;
  const std::string name = lowerCase(path);
  const auto ends = [&](const char* end) { return name.ends_with(end); };
  if (head->starts_with("\x1f\x8b")) {
    auto inside = readDecompressedHead(path, enough);
    if (inside && isNiftiHead(*inside)) return Format::nifti;
  } else if (isNiftiHead(*head)) {
    return Format::nifti;
  }
  if (ends(".nii") || ends(".nii.gz")) return Format::nifti;
  if (ends(".nrrd") || ends(".nhdr")) return Format::nrrd;
  if (ends(".mha") || ends(".mhd")) return Format::metaImage;
  return Format::none;
}

Result<ImageHeader> readHeader(const std::string& path) {
  switch (formatOf(path)) {
    case Format::nrrd:
      return readNrrdHeader(path);
    case Format::nifti:
      return readNiftiHeader(path);
    case Format::metaImage:
      return readMetaImageHeader(path);
    case Format::none:
      break;
  }
  if (auto file = DataFile::open(path); !file) return file.error();
  return Error{path + " is not a NRRD, NIfTI or MetaImage file."};
}

std::string fileName(const std::string& path) { return std::filesystem::path(path).filename().string(); }

// Which volume of its file a series is, from 0: the number behind "NAME#" in its id. More may stand behind
// it, which tells files of one name apart.
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

bool looksLikeImageFile(const std::string& path) { return formatOf(path) != Format::none; }

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
  const std::uint64_t count = header->data.volumes();
  if (count == 1) return std::vector<Series>{series};
  std::vector<Series> all;
  for (std::uint64_t n = 1; n <= count; ++n) {
    all.push_back(series);
    all.back().id += '#' + std::to_string(n);
    all.back().warnings.push_back("This is volume " + std::to_string(n) + " of " + std::to_string(count) +
                                  " in its file.");
  }
  return all;
}

Result<Loaded> loadImageFile(const Series& series, const Progress& progress, const CancelToken& cancel) {
  auto header = readHeader(series.path);
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
