#include <algorithm>
#include <cstring>
#include <map>
#include <new>

#include "io/dicom/decode.h"
#include "io/dicom/import.h"
#include "io/dicom/inspect_files.h"
#include "io/dicom/kept_headers.h"
#include "io/dicom/parallel.h"
#include "io/dicom/resample.h"
#include "io/dicom/series.h"
#include "io/dicom/unread.h"
#include "io/dicom/voxels.h"
#include "io/regular_file.h"
#include "io/worker/call.h"
#include "viewer/volume/buffer.h"

namespace volumen::dicom {
namespace {

/// A slice during loading.
struct Incoming {
  const FileHeader* file = nullptr;
  int number = 0;  ///< index within the series
  PlacedSlice placed;
  std::string failure;  ///< why it is missing; empty if it is not
  std::string note;
  bool inexact = false, doesNotFit = false;
  bool again = false;  ///< same as Refused::again
};

/// The files of a series, with headers kept since the study was opened or read now.
class Files {
 public:
  Files(const Series& series, const Progress& progress, const CancelToken& cancel)
      : size_(series.acquired.size) {
    for (const std::string& path : series.files) files_[path];
    std::vector<std::string> unknown;
    std::vector<std::optional<FileState>> states;
    for (auto& [path, file] : files_) {
      file.header = keptHeader(path);
      if (file.header) continue;
      unknown.push_back(path);
      states.push_back(fileState(path));
    }
    std::vector<Inspection> inspections = inspectFiles(unknown, progress, cancel);
    for (std::size_t n = 0; n < unknown.size(); ++n) {
      File& file = files_[unknown[n]];
      set(file, std::move(inspections[n]));
      if (file.header && states[n]) keepHeader(unknown[n], *states[n], file.header);
    }
  }
  Incoming slice(const std::string& path, int frame) const {
    const File& file = files_.at(path);
    Incoming in;
    in.placed.path = path;
    in.again = file.again;
    if (file.position) {
      Slice lost;
      lost.position = file.position;
      in.placed.slice = SharedSlice(std::move(lost));
    }
    if (!file.header) {
      in.failure = file.failure;
      return in;
    }
    const FileHeader& header = *file.header;
    if (!header.notVolume.empty())
      in.failure = header.notVolume + ".";
    else if (frame >= int(header.slices.size()))
      in.failure = "it has fewer frames than it had.";
    else if (header.format.columns != size_.x || header.format.rows != size_.y)
      in.failure = "its size is not that of the series.";
    else
      in.file = &header, in.placed.slice = SharedSlice::of(header.slices[std::size_t(frame)]);
    return in;
  }

 private:
  /// A header, or the reason why there is none.
  struct File {
    std::shared_ptr<const FileHeader> header;
    std::string failure;
    std::optional<glm::dvec3> position;
    bool again = false;
  };

  static void set(File& file, Inspection&& i) {
    file.again = i.again;
    file.position = i.position;
    if (i.kind == Inspection::Kind::picture)
      file.header = std::make_shared<FileHeader>(std::move(i.header));
    else
      file.failure = i.text.empty() ? "it is no DICOM picture any more." : i.text;
  }

  glm::ivec3 size_;
  std::map<std::string, File> files_;
};

std::vector<PlacedSlice> placedOf(const std::vector<Incoming>& slices) {
  std::vector<PlacedSlice> placed;
  for (const Incoming& in : slices) placed.push_back(in.placed);
  return placed;
}

/// Decodes all slices of a volume into one block of memory.
class SliceDecoder {
 public:
  SliceDecoder(std::vector<Incoming>& slices, const Progress& progress, const CancelToken& cancel)
      : slices_(slices), progress_(progress), cancel_(cancel), padding_(paddingOf(placedOf(slices))) {}

  /// Decodes all slices as `plan` says and marks those that fail.
  void run(const ValuePlan& plan) {
    plan_ = plan;
    sliceVoxels_ = slices_[0].file->format.frameSamples();
    values_ = plan.type;
    std::visit([&]<class T>(std::vector<T>& v) { v = zeros<T>(sliceVoxels_ * slices_.size()); }, values_);
    std::map<const FileHeader*, std::vector<std::size_t>> byFile;
    for (std::size_t n = 0; n < slices_.size(); ++n) byFile[slices_[n].file].push_back(n);
    const std::vector<std::pair<const FileHeader*, std::vector<std::size_t>>> files(byFile.begin(),
                                                                                    byFile.end());
    const bool oneFile = files.size() == 1;
    forEachParallel(files.size(), "decoding", oneFile ? Progress{} : progress_, cancel_,
                    [&](std::size_t n) { decodeFile(*files[n].first, files[n].second, oneFile); });
  }

  /// Removes failed slices.
  void compact() {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < slices_.size(); ++n) {
      if (!slices_[n].failure.empty()) continue;
      if (kept != n) {
        std::visit(
            [&](auto& v) {
              std::copy_n(v.begin() + std::ptrdiff_t(n * sliceVoxels_), sliceVoxels_,
                          v.begin() + std::ptrdiff_t(kept * sliceVoxels_));
            },
            values_);
      }
      ++kept;
    }
    std::visit([&](auto& v) { v.resize(kept * sliceVoxels_); }, values_);
    std::erase_if(slices_, [](const Incoming& in) { return !in.failure.empty(); });
  }

  VoxelValues& values() { return values_; }
  std::size_t sliceVoxels() const { return sliceVoxels_; }
  const std::optional<Padding>& padding() const { return padding_; }

 private:
  void decodeFile(const FileHeader& file, const std::vector<std::size_t>& slices, bool showFrames) {
    const Result<PixelSource> source = PixelSource::open(file, cancel_);
    forEachParallel(slices.size(), "decoding", showFrames ? progress_ : Progress{}, cancel_,
                    [&](std::size_t n) {
                      Incoming& in = slices_[slices[n]];
                      if (!source)
                        fail(in, source.message());
                      else
                        decodeSlice(*source, slices[n], in);
                    });
  }

  void decodeSlice(const PixelSource& source, std::size_t at, Incoming& in) {
    try {
      const Result<DecodedFrame> frame = source.frame(in.placed.slice->frame);
      if (!frame) {
        fail(in, frame.message());
        return;
      }
      in.note = frame->note;
      const Stored noticed =
          storeSamples(frame->samples, in.placed.slice, plan_, padding_, at * sliceVoxels_, values_);
      in.inexact = noticed.inexact, in.doesNotFit = noticed.doesNotFit;
    } catch (const std::bad_alloc&) {
      in.failure = "there is not enough memory to decode it.";
      in.again = true;
    }
  }

  static void fail(Incoming& in, const std::string& reason) {
    in.failure = reason + ".";
    in.again = worker::isReasonOfMachine(reason);
  }

  std::vector<Incoming>& slices_;
  const Progress& progress_;
  const CancelToken& cancel_;
  const std::optional<Padding> padding_;
  ValuePlan plan_;
  VoxelValues values_;
  std::size_t sliceVoxels_ = 0;
};

/// Adds the slices that failed to `unread`.
void addFailures(const std::vector<Incoming>& slices, std::vector<Unread>& unread) {
  for (const Incoming& in : slices)
    if (!in.failure.empty())
      unread.push_back({{in.placed.path, in.failure, in.again}, false, in.placed.slice->position});
}

/// Removes warnings about the layout of slices, which assumed that all could be read.
void forgetLayout(std::vector<Warning>& warnings) {
  std::erase_if(warnings, [](const Warning& w) {
    return w.kind == WarningKind::missingSlices || w.kind == WarningKind::unevenSlices ||
           w.kind == WarningKind::sheared || w.kind == WarningKind::offLine || w.kind == WarningKind::unread;
  });
}

/// Adds one sentence for each kind of note.
void reportNotes(const std::vector<Incoming>& slices, std::vector<Warning>& warnings) {
  std::map<std::string, std::string> firstFile;
  for (const Incoming& in : slices)
    if (!in.note.empty()) firstFile.emplace(in.note, fileName(in.placed.path));
  for (const auto& [note, file] : firstFile) warnings.push_back(file + ": " + note + ".");
  if (std::any_of(slices.begin(), slices.end(), [](const Incoming& in) { return in.inexact; }))
    warnings.emplace_back("Its values are wider than float32 and were rounded to it.");
}

std::vector<const FileHeader*> headersOf(const std::vector<Incoming>& slices) {
  std::vector<const FileHeader*> headers;
  for (const Incoming& in : slices) headers.push_back(in.file);
  return headers;
}

// Slices may have their own windows, some far off. Takes those of the slice whose first window is the median.
std::vector<Window> windowsOf(const std::vector<Incoming>& slices) {
  std::vector<const std::vector<Window>*> all;
  for (const Incoming& in : slices)
    if (!in.placed.slice->windows.empty()) all.push_back(&in.placed.slice->windows);
  if (all.empty()) return {};
  std::ranges::stable_sort(all, {}, [](const std::vector<Window>* windows) {
    return std::pair(windows->front().width, windows->front().centre);
  });
  return *all[all.size() / 2];
}

VolumeAttributes attributesOf(const Series& series, const std::vector<Incoming>& slices) {
  VolumeAttributes a;
  a.name = series.description.empty() ? fileName(series.path) : series.description;
  a.modality = series.modality;
  a.windows = windowsOf(slices);
  return a;
}

std::vector<SliceOrigin> originsOf(const std::vector<Incoming>& slices, const Stack& stack) {
  std::vector<SliceOrigin> origins;
  if (!stack.regular)
    for (const Incoming& in : slices) origins.push_back({in.number, in.number});
  for (const auto& [below, weight] : stack.sources)
    origins.push_back(
        {slices[std::size_t(below)].number, slices[std::size_t(below + (weight > 0 ? 1 : 0))].number});
  return origins;
}

Result<Loaded> assemble(const Series& series, const std::vector<Incoming>& slices, SliceDecoder& decoder,
                        const ValuePlan& plan, std::vector<Warning> warnings, std::vector<Unread> unread) {
  const PixelFormat& format = slices[0].file->format;
  const Slice& first = slices[0].placed.slice;
  Stack stack = layOut(placedOf(slices), format.columns, format.rows);
  warnOfUnread(unread, stack.regular, stack.warnings);
  for (const Warning& warning : stack.warnings)
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  VolumeParts parts;
  parts.attributes = attributesOf(series, slices);
  if (decoder.padding()) parts.attributes.padding = decoder.padding()->values;
  if (!plan.rescaled) parts.slope = first.slope, parts.intercept = first.intercept;
  VolumeParts drawn = parts;
  if (stack.regular) drawn.values = resampleSlices(decoder.values(), decoder.sliceVoxels(), stack.sources);
  parts.geometry = stack.acquired;
  parts.values = std::move(decoder.values());
  std::vector<std::string> changed;
  const auto acquired = Volume::make(std::move(parts), changed);
  if (!acquired) return Error{series.path + ": " + acquired.message()};
  addSentences(warnings, changed);
  if (!stack.regular) return Loaded{*acquired, *acquired, warnings, unread, originsOf(slices, stack)};
  drawn.geometry = stack.regular->geometry;
  std::vector<std::string> repeated;  // the warnings about the acquired slices hold for these
  const auto regular = Volume::make(std::move(drawn), repeated);
  if (!regular) return Error{series.path + ": " + regular.message()};
  return Loaded{*acquired, *regular, warnings, unread, originsOf(slices, stack), stack.places};
}

}  // namespace

Result<Loaded> loadSeries(const Series& series, const Progress& progress, const CancelToken& cancel) {
  if (series.files.empty()) return Error{series.path + ": it has no files to load it from."};
  const Files files(series, progress, cancel);
  std::vector<Incoming> slices;
  for (std::size_t n = 0; n < series.files.size(); ++n) {
    slices.push_back(files.slice(series.files[n], series.frames[n]));
    slices.back().number = int(n);
  }
  std::vector<Warning> warnings = series.warnings;
  std::vector<Unread> unread = series.unread;
  addFailures(slices, unread);
  const std::string reason = slices[0].failure;
  std::erase_if(slices, [](const Incoming& in) { return !in.failure.empty(); });
  if (cancel.cancelled()) return Error{series.path + ": interrupted."};
  if (slices.empty()) return Error{series.files[0] + ": " + reason};

  ValuePlan plan = planValues(headersOf(slices), placedOf(slices));
  SliceDecoder decoder(slices, progress, cancel);
  decoder.run(plan);
  if (std::any_of(slices.begin(), slices.end(), [](const Incoming& in) { return in.doesNotFit; })) {
    plan = {std::vector<float>{}, true};
    decoder.run(plan);
  }
  if (cancel.cancelled()) return Error{series.path + ": interrupted."};
  addFailures(slices, unread);
  if (unread.size() != series.unread.size()) forgetLayout(warnings);
  const Incoming firstSlice = slices[0];
  decoder.compact();
  if (slices.empty()) return Error{firstSlice.placed.path + ": " + firstSlice.failure};
  reportNotes(slices, warnings);
  return assemble(series, slices, decoder, plan, std::move(warnings), std::move(unread));
}

}  // namespace volumen::dicom
