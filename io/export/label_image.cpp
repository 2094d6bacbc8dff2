#include "io/export/label_image.h"

#include <algorithm>
#include <filesystem>
#include <new>

#include "io/export/label_table.h"
#include "io/files/image_file.h"
#include "io/files/label_values.h"
#include "io/files/write_volume.h"

namespace volumen {

namespace {

// Returns no rows if the table is missing or cannot be read.
std::vector<LabelRow> tableBeside(const std::string& path, SegmentsFile& file) {
  const std::string table = labelTableOf(path);
  std::error_code none;
  if (!std::filesystem::exists(table, none)) return {};
  file.files.push_back(table);
  auto rows = readLabelTable(table);
  if (rows) return std::move(*rows);
  file.notes.push_back(rows.message() + " None of its names and colours was taken.");
  return {};
}

// Returns the rows of the table, also those without voxels, and one for each label without a row.
Result<std::vector<LabelRow>> allRows(const LabelValues& values, std::vector<LabelRow> rows,
                                      const std::string& path) {
  std::vector<std::uint32_t> known;
  for (const LabelRow& row : rows) known.push_back(row.value);
  std::ranges::sort(known);
  if (std::ranges::adjacent_find(known) != known.end())
    return Error{labelTableOf(path) + " has two rows for the label " +
                 std::to_string(*std::ranges::adjacent_find(known)) + "."};
  for (const std::uint32_t value : values.present())
    if (!std::ranges::binary_search(known, value))
      rows.push_back({value, {.label = "Label " + std::to_string(value)}});
  return rows;
}

// A table may name more labels than a map can hold: rows without voxels are dropped then.
void keepThoseThere(const LabelValues& values, std::vector<LabelRow>& rows) {
  constexpr std::size_t most = 255;
  if (rows.size() <= most) return;
  const auto present = values.present();
  std::erase_if(rows, [&](const LabelRow& r) { return !std::ranges::binary_search(present, r.value); });
}

}  // namespace

Status writeLabelImage(const Segmented& segments, const std::string& path, const Progress& progress,
                       const CancelToken& cancel) try {
  if (!isVolumeFileName(path)) return Error{path + ": labels are written as .nii.gz, .mha or .nrrd."};
  VolumeParts parts;
  parts.geometry = segments.labels.geometry();
  parts.values = segments.labels.dense().labels;
  std::vector<std::string> warnings;
  const auto volume = Volume::make(std::move(parts), warnings);
  if (!volume) return volume.error();
  auto table = writeLabelTable(segments.segments, labelTableOf(path));
  if (!table) return table.error();
  if (Status s = writeVolume(**volume, path, progress, cancel); !s) return s;
  return table->commit();
} catch (const std::bad_alloc&) {
  return Error{"Cannot write " + path + ": there is not enough memory."};
}

Result<SegmentsFile> readLabelImage(const std::string& path, const Progress& progress,
                                    const CancelToken& cancel) try {
  const auto header = readImageHeader(path, cancel);
  if (!header) return header.error();
  if (header->data.volumes() != 1)
    return Error{path + " holds " + std::to_string(header->data.volumes()) +
                 " volumes; an image of labels holds one."};
  SegmentsFile file;
  const auto values = LabelValues::read(*header, 0, path, file.notes, progress, cancel);
  if (!values) return values.error();
  auto rows = allRows(*values, tableBeside(path, file), path);
  if (!rows) return rows.error();
  keepThoseThere(*values, *rows);
  std::vector<std::uint32_t> numbers;
  for (const LabelRow& row : *rows) numbers.push_back(row.value);
  const auto labels = labelsFor(numbers);
  if (!labels) return Error{path + ": " + labels.message()};
  Segmented map{{}, LabelMap(values->labels(*labels))};
  for (std::size_t n = 0; n < rows->size(); ++n) {
    map.segments.push_back((*rows)[n].segment);
    map.segments.back().number = (*labels)[n].label;
  }
  file.maps.push_back(std::move(map));
  return file;
} catch (const std::bad_alloc&) {
  return Error{path + ": there is not enough memory for its labels."};
}

}  // namespace volumen
